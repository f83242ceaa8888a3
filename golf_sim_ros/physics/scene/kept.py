# Copyright 2026 golf_sim_ros maintainers
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.

"""What was built for a record is kept, and found again for any record that holds the same.

Records hold arrays, which can be neither hashed nor trusted to stay as they are. So what is kept
is found by the values themselves, arrays by their bytes: an array that was written to is another
one, and a course that another process sent is the same one. To copy and compare bytes takes less
than a tenth of the time of a digest; only of large arrays a digest is kept in place of a copy.
"""

from functools import wraps
from hashlib import blake2b
from threading import Lock
from typing import Any, Callable, Hashable

import numpy as np

MOST_KEPT = 8  # results of each function, the last ones used
LARGE = 10_000_000  # bytes: of a larger array a digest is kept


def kept(build: Callable) -> Callable:
    """Build what a function of one record returns once for records of equal values.

    The result is shared, also between threads, so nobody may write into it.
    """
    found: list[tuple[Hashable, Any]] = []
    lock = Lock()

    @wraps(build)
    def look_up(record: tuple) -> Any:
        key = fingerprint(record)
        with lock:
            for i, (other, result) in enumerate(found):
                if other == key:
                    found.insert(0, found.pop(i))
                    return result
        result = build(record)
        with lock:
            found.insert(0, (key, result))
            del found[MOST_KEPT:]
        return result

    return look_up


def fingerprint(value: Any) -> Hashable:
    """Return a hashable value that is equal for records, tuples and arrays of equal content."""
    if isinstance(value, np.ndarray):
        if value.dtype.hasobject:
            raise TypeError(f'an array of {value.dtype} has no bytes to compare')
        if value.nbytes > LARGE:
            whole = blake2b(np.ascontiguousarray(value).view(np.uint8).data).digest()
        else:
            whole = value.tobytes()
        return value.dtype.str, value.shape, whole
    if isinstance(value, dict):
        return dict, fingerprint(tuple(value.items()))
    try:
        hash(value)
    except TypeError:
        return type(value), tuple(map(fingerprint, value))
    return type(value), value
