"""Studies of models that hold what cannot be sent to workers."""

import os
import threading

import acausal as ac
from acausal import Model, Scalar, der, output, structural, variable

LOCK = threading.Lock()


class Base(Model):
    x: Scalar = output("x")
    y: Scalar = variable("y", start=1, fixed=True)
    law = structural("law", default=None)

    def equations(self):
        yield der(self.y) == -self.y
        yield self.x == self.y


def studied(model):
    ac.study(model, stop_time=0.1, tolerances=(1e-3, 1e-4), workers=1)


def open_file_in_a_model(repaired):
    with open(os.devnull, "w") as file:
        studied(Base(law=os.devnull if repaired else file))


def generator_in_a_model(repaired):
    studied(Base(law=tuple(range(3)) if repaired else (k for k in range(3))))


def lock_in_a_part(repaired):
    class M(Model):
        x: Scalar = output("x")
        part = Base(law=None if repaired else LOCK)

        def equations(self):
            yield self.x == self.part.x

    studied(M())


def lock_in_an_equation(repaired):
    class M(Base):
        def equations(self):
            LOCK.locked()
            yield from super().equations()

    studied(Base() if repaired else M())


def event_in_a_list(repaired):
    studied(Base(law=["a", None if repaired else threading.Event()]))


def function_without_a_name(repaired):
    """A lambda can be sent; what it holds may be the culprit."""
    lock = threading.Lock()
    studied(Base(law=(lambda t: t) if repaired else (lambda t: (t, lock))))
