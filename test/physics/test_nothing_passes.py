# SPDX-License-Identifier: Apache-2.0
"""No shot passes through anything; `make hard` fires a hundred thousand at each target."""
from nothing_passes import TARGETS
import pytest

COUNT = 60


@pytest.mark.parametrize('target', TARGETS)
@pytest.mark.parametrize('accuracy', ['sketch', 'standard'])
def test_no_shot_passes_through(target, accuracy):
    passed, depth = TARGETS[target]((COUNT, accuracy, 250))
    assert passed == 0 and depth < 2e-6
