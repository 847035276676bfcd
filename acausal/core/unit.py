"""Model files that the core has read."""

from __future__ import annotations

from ctypes import byref, c_int32

from acausal.core.library import loaded


class Unit:
    """A model file that the core has read; it does not change, and runs share it.

    Parameters
    ----------
    content : bytes
        The file.

    Raises
    ------
    ValueError
        If the file is not readable.
    """

    def __init__(self, content: bytes) -> None:
        self.library, self.memory, why = loaded(), None, c_int32()
        self.memory = self.library.ac_unit_read(content, len(content), byref(why))
        if not self.memory:
            raise ValueError(f"the model file is not readable: reason {why.value}")

    def __del__(self) -> None:
        if getattr(self, "memory", None):
            self.library.ac_unit_free(self.memory)
