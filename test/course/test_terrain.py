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

"""Height maps as surveys give them: GeoTIFF, ESRI ASCII grids, missing heights, units, origins."""

from pathlib import Path
import sys

from golf_sim_ros.course import load_course
from golf_sim_ros.course.missing_heights import filled
from golf_sim_ros.course.schema import CourseError
from golf_sim_ros.physics import ground_height, Shot, simulate
from golf_sim_ros.physics.scene.kept import fingerprint
import numpy as np
import pytest

CASES = Path(__file__).parents[1] / 'data' / 'cases'
EAST, NORTH = 500_000.0, 5_300_000.0  # a corner in UTM
ROWS, COLUMNS, CELL = 30, 41, 2.0
X, Y = np.meshgrid(np.arange(COLUMNS) * CELL, np.arange(ROWS) * CELL)
GREEN = (
    350.0 + np.sin(X / 9) + 0.02 * Y + np.random.default_rng(4).normal(0, 0.01, X.shape)
).astype('float32')
SHOT = Shot((18.0, 0.5, 9.0), (0.0, -200.0, 10.0))


@pytest.fixture
def course(tmp_path):
    """Write a course with one height map; gives what load_course gives."""

    def write(name, more=''):
        path = tmp_path / 'links.yaml'
        path.write_text(
            f'format: 1\ntee: [20, 20]\nhole: [40, 22]\nground:\n'
            f'  - {{shape: heightmap, material: fairway, heights: {name}{more}}}\n'
        )
        return load_course(path)

    return write


@pytest.fixture
def complaint(course):
    """Load a map that is refused; gives what is said after the file's name."""

    def complaint(name, more=''):
        with pytest.raises(CourseError) as caught:
            course(name, more)
        said = str(caught.value)
        assert said.isprintable() and len(said) <= 300
        return said.partition(f'{name}: ')[2]

    return complaint


def geotiff(
    path,
    heights=GREEN,
    none=None,
    crs='EPSG:32633',
    cell=(CELL, CELL),
    corner=(EAST, NORTH),
    **more,
):
    """Write a GeoTIFF, rows from north; `corner`: of the first height, in the south west."""
    rasterio = pytest.importorskip('rasterio')
    dx, dy = cell
    north = corner[1] + (len(heights) - 0.5) * dy
    way = rasterio.Affine(dx, more.pop('turn', 0.0), corner[0] - 0.5 * dx, 0.0, -dy, north)
    bands = more.pop('bands', 1)
    units = more.pop('units', None)
    with rasterio.open(
        path,
        'w',
        driver='GTiff',
        height=len(heights),
        width=len(heights[0]),
        count=bands,
        dtype=heights.dtype,
        nodata=none,
        transform=way,
        crs=crs,
        **more,
    ) as file:
        for band in range(bands):
            file.write(heights[::-1], band + 1)
        if units:
            file.units = (units,) * bands


def esri(path, heights=GREEN, corner=(EAST, NORTH), cell=CELL, kind='corner', end='\n'):
    """Write an ESRI ASCII grid, rows from north."""
    off = 0.5 * cell if kind == 'corner' else 0.0
    head = [
        f'ncols         {len(heights[0])}',
        f'nrows {len(heights)}',
        f'xll{kind} {corner[0] - off!r}',
        f'YLL{kind.upper()}\t{corner[1] - off!r}',
        f'cellsize {cell!r}',
        'NODATA_value  -9999',
    ]
    path.write_text(
        end.join([*head, *(' '.join(map(repr, row)) for row in heights[::-1].tolist())]) + end
    )


def played(course):
    """All that a shot does, in numbers."""
    play = simulate(course, SHOT)
    return [
        (event.position, event.velocity_after) for event in play.collisions
    ], play.result.position


SUBTRACT = f', subtract: [{EAST - 10}, {NORTH - 5}]'


@pytest.mark.parametrize('way', ['tif', 'asc', 'center.asc', 'crlf.asc'])
def test_geotiff_and_asc_play_the_same_as_their_npy_to_the_bit(course, tmp_path, way):
    np.save(tmp_path / 'green.npy', GREEN)
    if way == 'tif':
        geotiff(
            tmp_path / 'green.tif',
            none=-9999.0,
            compress='deflate',
            predictor=3,
            tiled=True,
            blockxsize=16,
            blockysize=16,
        )
    else:
        esri(
            tmp_path / f'green.{way}',
            kind='center' if 'center' in way else 'corner',
            end='\r\n' if 'crlf' in way else '\n',
        )
    plain = course('green.npy', f', origin: [10, 5], spacing: {CELL}')
    found = course(f'green.{way}', SUBTRACT)
    assert fingerprint(found.ground) == fingerprint(plain.ground) and found.notes == ()
    assert played(found) == played(plain)
    again = course(f'green.{way}', ', origin: [10, 5]')
    assert fingerprint(again.ground) == fingerprint(plain.ground)


def test_no_data_is_refused_with_its_place_or_filled_alike(course, complaint, tmp_path):
    heights = GREEN.copy()
    heights[12:14, 20] = -9999.0
    np.save(tmp_path / 'green.npy', heights)
    esri(tmp_path / 'green.asc', heights)
    geotiff(tmp_path / 'green.tif', heights, none=-9999.0)
    geotiff(tmp_path / 'nan.tif', np.where(heights < 0, np.float32(np.nan), heights))
    ways = [
        ('green.npy', f', origin: [10, 5], spacing: {CELL}'),
        ('green.asc', SUBTRACT),
        ('green.tif', SUBTRACT),
        ('nan.tif', SUBTRACT),
    ]
    for name, more in ways:
        said = complaint(name, more)
        assert said.startswith(
            f'height [12, 20] is {"nan" if name == "nan.tif" else -9999}, at x 50, y 29: 2 of 1230'
        )
        assert '`fill: true`' in said
    courses = [course(name, more + ', fill: true') for name, more in ways]
    assert len({fingerprint(one.ground) for one in courses}) == 1
    assert [one.notes[0].partition(': ')[2] for one in courses] == [
        '2 of 1230 heights stood for no data, the first at x 50, y 29, '
        'and were filled from those around'
    ] * 4
    found = np.array(courses[0].ground[0].heights)
    assert np.abs(found - GREEN)[12:14, 20].max() < 0.1
    np.testing.assert_array_equal(found[heights > 0], GREEN[heights > 0])


def test_the_case_of_1710_m_beside_no_data_is_refused_or_filled_and_flat():
    with pytest.raises(
        CourseError, match=r'height \[0, 0\] is -9999, at x 0, y 0: 84 of 441 stand for no data'
    ):
        load_course(CASES / 'nodata.yaml')
    heights = np.load(CASES / 'nodata.npy')
    assert (filled(np.where(heights == -9999, np.nan, heights)) == 1710.0).all()


@pytest.mark.parametrize(
    'heights, more',
    [
        (np.where(GREEN > 351.2, 0.0, GREEN), ', no_data: 0'),
        (np.where(GREEN > 351.2, np.nan, GREEN), ''),
        (np.where(GREEN > 351.2, np.inf, GREEN), ''),
        (np.where(GREEN > 351.2, -32768, np.round(GREEN)).astype('int16'), ''),
        (np.where(GREEN > 351.2, -3.4028234663852886e38, GREEN), ''),
    ],
)
def test_what_stands_for_no_data_is_known_or_said(course, complaint, tmp_path, heights, more):
    np.save(tmp_path / 'green.npy', heights)
    more += ', origin: [10, 5], spacing: 2'
    assert f'{(GREEN > 351.2).sum()} of 1230 stand for no data' in complaint('green.npy', more)
    found = np.array(course('green.npy', more + ', fill: true').ground[0].heights)
    assert 348.9 <= found.min() and found.max() < 353


def test_holes_are_filled_with_smooth_ground_within_what_is_around():
    x, y = np.meshgrid(np.arange(60.0), np.arange(47.0))
    plane = 3.0 + 0.1 * x - 0.07 * y
    rng = np.random.default_rng(1)
    holes = np.hypot(x - 20, y - 20) < 6
    holes |= rng.random(x.shape) < 0.2
    found = filled(np.where(holes, np.nan, plane))
    inner = np.s_[3:-3, 3:-3]
    assert np.abs(found - plane)[inner].max() < 0.12  # a step of the plane
    assert plane[~holes].min() <= found.min() and found.max() <= plane[~holes].max()
    np.testing.assert_array_equal(found[~holes], plane[~holes])


def test_heights_that_jump_by_hundreds_of_metres_are_told(course, tmp_path):
    heights = GREEN.copy()
    heights[1, 1] = 0.0
    np.save(tmp_path / 'green.npy', heights)
    note, *_ = course('green.npy', ', origin: [10, 5], spacing: 2').notes
    assert note.startswith('green.npy: heights jump by 35') and 'beside the one at x 1' in note


def test_feet_and_heights_in_other_units_are_metres_in_play(course, tmp_path):
    foot, us_foot = 0.3048, 1200 / 3937
    # New York, US survey feet
    geotiff(tmp_path / 'ft.tif', crs='EPSG:2263', corner=(980_000.0, 200_000.0))
    geotiff(tmp_path / 'm_ft.tif', units='ft')
    esri(tmp_path / 'ft.asc')
    esri(tmp_path / 'm.asc')
    near = ', subtract: [979930, 199950, 300]'
    far = f', subtract: [{EAST - 70}, {NORTH - 50}, 300]'
    for name, more, size, high in (
        ('ft.tif', near, us_foot, us_foot),
        ('ft.tif', near + ', height_unit: metres', us_foot, 1.0),
        ('m_ft.tif', far, 1.0, foot),
        ('ft.asc', far + ', unit: feet', foot, foot),
        ('m.asc', far + ', height_unit: feet', 1.0, foot),
    ):
        path = tmp_path / 'links.yaml'
        path.write_text(
            'format: 1\ntee: [25, 20]\nground:\n'
            f'  - {{shape: heightmap, material: fairway, heights: {name}{more}}}\n'
            '  - {shape: plane, material: rough, point: [0, 0, -900]}\n'
        )
        shape = load_course(path).ground[0]
        assert shape.spacing == pytest.approx(CELL * size, rel=1e-12)
        assert shape.origin == pytest.approx((70 * size, 50 * size), rel=1e-12)
        np.testing.assert_allclose(shape.heights, (GREEN.astype(float) - 300) * high, rtol=1e-12)


def test_degrees_are_refused_with_what_to_do(complaint, tmp_path):
    geotiff(tmp_path / 'green.tif', crs='EPSG:4326', cell=(1e-5, 1e-5), corner=(15.2, 47.1))
    said = complaint('green.tif')
    assert said.startswith('is in degrees: project it to metres, as') and 'EPSG:32633' in said
    esri(tmp_path / 'green.asc', cell=2.7e-4, corner=(151.2, -33.9))
    said = complaint('green.asc')
    assert said.startswith('seems to be in degrees, at 151.2, -33.9') and 'EPSG:32756' in said


def test_what_does_not_fit_is_refused(complaint, tmp_path):
    geotiff(tmp_path / 'a.tif')
    assert complaint('a.tif').startswith(
        'lies at 500000, 5300000: say where the course has its origin there'
    )
    assert 'says its cell size itself, 2: leave out' in complaint('a.tif', ', spacing: 2')
    assert "both 'origin' and 'subtract' are given" in complaint(
        'a.tif', SUBTRACT + ', origin: [0, 0]'
    )
    geotiff(tmp_path / 'a.tif', bands=3)
    assert 'has 3 bands' in complaint('a.tif')
    geotiff(tmp_path / 'a.tif', cell=(2.0, 3.0))
    assert 'has cells of 2 x 3, and they must be squares' in complaint('a.tif')
    geotiff(tmp_path / 'a.tif', turn=0.1)
    assert 'is turned against its coordinates' in complaint('a.tif')
    np.save(tmp_path / 'a.npy', GREEN)
    assert "key 'spacing' is needed" in complaint('a.npy')
    assert "leave out 'subtract'" in complaint('a.npy', ', spacing: 2, subtract: [0, 0]')
    (tmp_path / 'a.txt').write_text('1 2')
    assert 'is no height map; known: .asc, .npy, .tif, .tiff' in complaint('a.txt')


@pytest.mark.parametrize(
    'content, said',
    [
        ('', 'is empty'),
        ('north: 1', 'does not begin with ncols'),
        ('ncols 2\nnrows 2\n1 2 3 4', "'cellsize' is missing"),
        (
            'ncols 2 nrows 2 xllcorner 0 yllcorner 0 cellsize 1\n1 2 3',
            'tells of 2 rows of 2 heights and has 3',
        ),
        (
            'ncols 2 nrows 2 xllcorner 0 yllcorner 0 cellsize 1\n1 2 3 x',
            'is no ESRI ASCII grid: could not convert',
        ),
        ('ncols 2 nrows 2 xllcorner 0 yllcorner 0 cellsize 0\n1 2 3 4', 'has cells of 0 x 0'),
        ('ncols -2 nrows -2 xllcorner 0 yllcorner 0 cellsize 1\n1 2 3 4', 'tells of -2 rows'),
        (
            'ncols 2 nrows 2 xllcorner 0 yllcorner 0 cellsize 1 nodata_value 1\n1 1 1 1',
            'holds no heights',
        ),
    ],
)
def test_a_broken_grid_is_refused_in_one_line(complaint, tmp_path, content, said):
    (tmp_path / 'a.asc').write_text(content)
    assert said in complaint('a.asc')


def test_a_broken_geotiff_is_refused_in_one_line_and_a_missing_rasterio_told(
    complaint, tmp_path, monkeypatch
):
    geotiff(tmp_path / 'a.tif')
    raw = (tmp_path / 'a.tif').read_bytes()
    for size in (4, 100, len(raw) // 2):
        (tmp_path / 'a.tif').write_bytes(raw[:size])
        assert 'cannot be read by rasterio' in complaint('a.tif')
    monkeypatch.setitem(sys.modules, 'rasterio', None)
    assert complaint('a.tif').startswith(
        'needs rasterio: sudo apt install python3-rasterio, or pip install '
    )


def test_a_place_without_ground_is_told_where_the_map_is(course, tmp_path):
    np.save(tmp_path / 'green.npy', GREEN)
    with pytest.raises(
        CourseError, match=r'and there is none; green.npy reaches x 900 to 980, y 5 to 63'
    ):
        course('green.npy', ', origin: [900, 5], spacing: 2')


def test_rows_run_from_south_in_play(course, tmp_path):
    geotiff(tmp_path / 'green.tif')
    found = course('green.tif', SUBTRACT)
    for row, column in ((0, 0), (5, 7), (29, 40)):
        place = 10 + column * CELL, 5 + row * CELL
        assert ground_height(found, *place)[0] == pytest.approx(GREEN[row, column], abs=1e-9)
