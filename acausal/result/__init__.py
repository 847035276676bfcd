"""Results: every variable of a run by the name that the user gave, as arrays, tables and pictures."""

from acausal.result.files import check_writable, document, read_text, same_file, shown_name
from acausal.result.lookup import check_columns, match, names
from acausal.result.plots import check_picture
from acausal.result.result import Result

__all__ = [
    "Result",
    "check_columns",
    "check_picture",
    "check_writable",
    "document",
    "match",
    "names",
    "read_text",
    "same_file",
    "shown_name",
]
