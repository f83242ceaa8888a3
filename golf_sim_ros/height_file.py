# SPDX-License-Identifier: Apache-2.0
"""Heights on a grid from a .npy file, checked."""
from io import BytesIO

import numpy as np

from .checked import FAR, CourseError, text


def heights_in(folder, sources):
    """Checker of the name of a .npy file with heights, relative to `folder`.

    Returns rows of heights [m], a tuple of tuples, rows along x; puts the file's bytes into `sources` under
    its name. Raises `CourseError`, one line with file and reason.
    """
    def check(value, key):
        path = folder / text(value, key)
        try:
            raw = path.read_bytes()
        except (OSError, ValueError) as error:
            reason = getattr(error, 'strerror', None) or error
            raise CourseError(f'{key} {path}: cannot be read: {reason}') from None
        sources[value] = raw
        try:
            return grid(raw)
        except ValueError as error:
            raise CourseError(f'{key} {path}: {error}') from None
    return check


def grid(raw):
    """Rows of heights in the bytes of a .npy file; ValueError where it holds anything else."""
    if not raw.startswith(b'\x93NUMPY'):
        raise ValueError('is no .npy file')
    try:
        found = np.load(BytesIO(raw), allow_pickle=False)
    except Exception as error:  # numpy has many ways of saying that a file is broken
        raise ValueError(f'is no .npy file that can be read: {" ".join(str(error).split())}') from None
    if found.dtype.kind not in 'fiu':
        raise ValueError(f'must hold numbers, not {found.dtype}')
    if found.ndim != 2 or min(found.shape) < 2:
        raise ValueError(f'must hold rows of heights, 2 x 2 or more; its shape is {found.shape}')
    found = found.astype(float)
    if not (np.abs(found) <= FAR).all():
        row, column = np.argwhere(~(np.abs(found) <= FAR))[0]
        raise ValueError(f'height [{row}, {column}] is {found[row, column]} and must be a number from '
                         f'{-FAR:g} to {FAR:g}')
    return tuple(map(tuple, found.tolist()))
