"""Counts the values of an example that are compared with known answers; says at its end how many are right."""

import numpy as np

_right, _errors = [], []


def difference(values, other, largest=None):
    """The largest difference, over the largest value."""
    return np.abs(values - other).max() / (largest or np.abs(other).max())


def hold(is_so, what):
    """Count something that is known to be so."""
    _right.append(bool(is_so))
    if not is_so:
        print(f"wrong: {what}")


def compare(error, allowed, what):
    """Count a relative error, right if it is not beyond `allowed`. Not-a-number is wrong."""
    _errors.append(abs(error))
    hold(abs(error) <= allowed, what)


def give(reference):
    """Print the last line of the output; the exit status is 1 if a value is wrong."""
    print(f"\nverdict: {sum(_right)} of {len(_right)} {reference}, worst {max(_errors):.1E}")
    raise SystemExit(not all(_right))
