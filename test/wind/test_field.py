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

"""Wind fields on disk: saved, loaded, and refused where they are broken or of another course."""

from io import BytesIO
import pickle
from zipfile import ZipFile

from golf_sim_ros.physics import LogProfile, PowerProfile
from golf_sim_ros.wind import FieldError, WindField
from golf_sim_ros.wind.field import coefficients, spline
import numpy as np
import pytest
from solvable import mounds, needs_numba, places


@pytest.fixture(scope='module')
def solved():
    """Field of the mounds, in three directions."""
    from golf_sim_ros.wind import solve

    return solve(mounds(), 3, 'sketch')


@needs_numba
def test_a_saved_field_is_the_same_when_loaded(solved, tmp_path):
    solved.save(tmp_path / 'wind.npz')
    again = WindField.load(tmp_path / 'wind.npz')
    assert again.atlas.ratios.tobytes() == solved.atlas.ratios.tobytes()
    where = places(solved, 200)
    wind = (5.0, 2.0, 0.0)
    assert again.velocity(where, wind) == pytest.approx(solved.velocity(where, wind), abs=1e-4)
    assert (again.digest, again.accuracy) == (solved.digest, 'sketch')


@needs_numba
def test_a_compact_file_is_small_and_nearly_the_same(solved, tmp_path):
    for name, compact in (('whole', False), ('compact', True)):
        solved.save(tmp_path / name, compact)
    assert (tmp_path / 'compact').stat().st_size < 0.2 * (tmp_path / 'whole').stat().st_size
    again = WindField.load(tmp_path / 'compact')
    assert abs(again.cells.ratios - solved.cells.ratios).max() <= 1.01e-3


@needs_numba
def test_it_fits_its_own_land_only(solved):
    course = mounds()
    solved.fits(course)
    solved.fits(course._replace(tee=(8.0, 0.0)))  # the wind does not depend on that
    leaves = course.obstacles[0]
    others = {
        'ground': course.ground[0]._replace(spacing=4.1),
        'obstacles': leaves._replace(radius=4.0),
        'wind_profile': LogProfile(0.02),
    }
    for key, other in others.items():
        value = other if key == 'wind_profile' else (other,)
        with pytest.raises(FieldError, match='another ground, other trees or another roughness'):
            solved.fits(course._replace(**{key: value}))
    with pytest.raises(FieldError, match='logarithmic wind_profile, and this is PowerProfile'):
        solved.fits(course._replace(wind_profile=PowerProfile()))


@needs_numba
@pytest.mark.parametrize('share', [0.0, 0.01, 0.3, 0.7, 0.999])
@pytest.mark.parametrize('compact', [False, True])
def test_a_truncated_file_is_refused_in_one_line(solved, tmp_path, share, compact):
    path = tmp_path / 'wind.npz'
    solved.save(path, compact)
    raw = path.read_bytes()
    path.write_bytes(raw[: int(share * len(raw))])
    check_refused(path)


@needs_numba
def test_flipped_bytes_are_refused_in_one_line_or_harmless(solved, tmp_path):
    path = tmp_path / 'wind.npz'
    solved.save(path, compact=True)
    raw = path.read_bytes()
    random = np.random.default_rng(3)
    for _ in range(60):
        broken = bytearray(raw)
        broken[random.integers(len(raw))] ^= int(random.integers(1, 256))
        path.write_bytes(bytes(broken))
        try:
            field = WindField.load(path)
        except FieldError as error:
            assert '\n' not in str(error)
        else:
            assert np.isfinite(field.atlas.ratios).all()


def check_refused(path, reason=None):
    """Check that a file is refused in one line that names it."""
    with pytest.raises(FieldError, match=reason) as told:
        WindField.load(path)
    assert str(told.value).startswith(f'{path}: ') and '\n' not in str(told.value)
    assert len(str(told.value)) < 400


def with_changed(solved, tmp_path, **changes):
    """File of a field of which some arrays are others."""
    path = tmp_path / 'wind.npz'
    solved.save(path)
    content = dict(np.load(path))
    content.update(changes)
    np.savez(path, **{name: value for name, value in content.items() if value is not None})
    return path


@needs_numba
@pytest.mark.parametrize(
    'changes, reason',
    [
        ({'format': 99}, 'is no wind field of format 1'),
        ({'format': None}, 'is no wind field of format 1'),
        ({'ratios': np.zeros(3)}, 'ratios have the type'),
        ({'ratios': np.array(['a', 'b'])}, 'ratios have the type'),
        ({'angles': np.array([0.0, 1.0])}, 'angles has the type'),
        ({'angles': np.array([2.0, 1.0, 0.0])}, 'angles does not rise'),
        ({'angles': np.array([0.0, 1.0, np.nan])}, 'angles is not finite'),
        ({'roughness': None}, 'is no wind field: .*roughness'),
        ({'heights': np.array([0.0, 0.2, 0.0, 300.0, 0.01])}, 'a length is not over 0'),
        ({'heights': np.full(5, np.inf)}, 'heights is not finite'),
        ({'ground_x': np.zeros(0)}, 'the shape'),
        ({'plan': np.zeros((2, 2))}, 'a length is not over 0'),
        ({'angles': np.array([0.0, 1.0, 7.0])}, 'an angle is not from 0 to below a whole turn'),
    ],
)
def test_what_no_field_can_hold_is_refused_in_one_line(solved, tmp_path, changes, reason):
    check_refused(with_changed(solved, tmp_path, **changes), reason)


@needs_numba
def test_ratios_that_are_not_finite_are_refused(solved, tmp_path):
    ratios = solved.cells.ratios.copy()
    ratios[0, 1, 1, 1, 0] = np.nan
    check_refused(with_changed(solved, tmp_path, ratios=ratios), 'not finite')


@needs_numba
@pytest.mark.parametrize('claimed', [(10**6, 10**4, 10**3, 20, 4), (2**14, 2**13), (2**40, 2**40)])
def test_what_claims_to_be_huge_is_refused_without_room_for_it(solved, tmp_path, claimed):
    path = tmp_path / 'wind.npz'
    solved.save(path)
    with ZipFile(path) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    header = BytesIO()
    claim = {'descr': '<f4', 'fortran_order': False, 'shape': claimed}
    np.lib.format.write_array_header_1_0(header, claim)
    members['ratios.npy'] = header.getvalue()
    with ZipFile(path, 'w') as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    check_refused(path, 'is no wind field')


@needs_numba
def test_a_file_that_unpacks_to_more_than_any_field_is_refused_unread(
    solved, tmp_path, monkeypatch
):
    from golf_sim_ros.wind import field

    path = tmp_path / 'wind.npz'
    solved.save(path)
    monkeypatch.setattr(field, 'MOST_BYTES', solved.cells.ratios.nbytes)
    monkeypatch.setattr(np.lib.format, 'read_array', None)
    check_refused(path, 'unpacked it has [0-9]+ bytes')


class Trap:
    """What would be noticed if it was unpickled."""

    def __reduce__(self):
        return pytest.fail, ('it was opened',)


@needs_numba
def test_pickles_are_not_opened(solved, tmp_path):
    path = tmp_path / 'wind.npz'
    path.write_bytes(pickle.dumps(Trap()))
    check_refused(path, 'is no wind field')
    buffer = BytesIO()
    np.save(buffer, np.array([Trap()], dtype=object), allow_pickle=True)
    path.write_bytes(buffer.getvalue())
    check_refused(path, 'is no wind field')
    check_refused(with_changed(solved, tmp_path, ratios=np.array([{}], dtype=object)))


def test_a_missing_file_is_one_line(tmp_path):
    check_refused(tmp_path / 'none.npz', 'No such file')


def test_coefficients_are_those_of_splines_through_the_values():
    values = np.random.default_rng(0).normal(size=(2, 5, 4, 6, 4))
    found = coefficients(values).astype(float)
    again = np.zeros_like(values)
    along_x, along_y, along_z = (spline(np.arange(n, dtype=float), n) for n in (5, 4, 6))
    for i, a in zip(*along_x):
        for j, b in zip(*along_y):
            for k, c in zip(*along_z):
                weight = a[:, None, None, None] * b[:, None, None] * c[:, None]
                again += weight * found[:, i][:, :, j][:, :, :, k]
    assert again == pytest.approx(values, abs=1e-5)
