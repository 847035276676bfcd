"""Range of validity of beam models."""


def beam_range(beam, frames):
    return iter(())
