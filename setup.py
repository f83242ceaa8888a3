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

"""How pip and colcon install golf_sim_ros."""

from pathlib import Path

from setuptools import find_packages, setup

HERE = Path(__file__).resolve().parent  # also where colcon runs a symlink to this file
PACKAGE = 'golf_sim_ros'
SHARE = f'share/{PACKAGE}'
EXECUTABLES = {
    'sim_node': 'golf_sim_ros.nodes.sim_node:main',
    'wind_node': 'golf_sim_ros.nodes.wind_node:main',
    'shoot': 'golf_sim_ros.cli.shoot:main',
    'record_play': 'golf_sim_ros.cli.record_play:main',
    'resimulate': 'golf_sim_ros.cli.resimulate:main',
    'plot_play': 'golf_sim_ros.cli.plot_play:main',
    'view_play': 'golf_sim_ros.cli.view_play:main',
    'play_hole': 'golf_sim_ros.cli.play_hole:main',
    'accuracy_study': 'golf_sim_ros.cli.accuracy_study:main',
    'compare_shots': 'golf_sim_ros.cli.compare_shots:main',
    'compile_physics': 'golf_sim_ros.cli.compile_physics:main',
    'wind_field': 'golf_sim_ros.cli.wind_field:main',
}

# ROS 2 as wheels from PyPI, for machines without it: Linux x86-64 only.
WHEELS = [
    'rclpy',
    'rmw-fastrtps-cpp',
    'rcl-interfaces',
    'std-msgs',
    'std-srvs',
    'geometry-msgs',
    'visualization-msgs',
    'diagnostic-msgs',
    'rosgraph-msgs',
]

# flake8 with the plugins of ament_flake8. The layout of ruff changes from one 0.x to the next.
LINTERS = [
    'flake8',
    'flake8-blind-except',
    'flake8-builtins',
    'flake8-class-newline',
    'flake8-comprehensions',
    'flake8-deprecated',
    'flake8-docstrings',
    'flake8-import-order',
    'flake8-quotes',
]

# Without numba all works, many balls and batches slowly: it is asked for only where it comes as a
# wheel.
NUMBA = (
    'numba; python_version < "3.15" and ('
    + ' or '.join(
        f'platform_machine == "{machine}"' for machine in ('x86_64', 'AMD64', 'aarch64', 'arm64')
    )
    + ')'
)


def folders(top):
    """Entries for data_files that copy a folder with all that is in it."""
    inside = [
        path for path in sorted(Path(top).rglob('*')) if path.is_file() and path.suffix != '.pyc'
    ]
    return [(f'{SHARE}/{path.parent.as_posix()}', [path.as_posix()]) for path in inside]


setup(
    name=PACKAGE,
    version='0.2.0',
    description='Golf as a physics simulation on ROS 2',
    long_description=(HERE / 'README.md').read_text(encoding='utf-8'),
    long_description_content_type='text/markdown',
    license='Apache-2.0',
    maintainer='golf_sim_ros maintainers',
    maintainer_email='maintainers@golf-sim-ros.example.org',
    python_requires='>=3.10',
    packages=find_packages(include=[PACKAGE, f'{PACKAGE}.*']),
    package_data={PACKAGE: ['py.typed'], f'{PACKAGE}.view': ['*.js', 'js/*.js']},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{PACKAGE}']),
        (SHARE, ['package.xml']),
        # pip puts console_scripts into bin/, where `ros2 run` does not look: it finds these.
        (f'lib/{PACKAGE}', [f'scripts/{name}' for name in EXECUTABLES]),
        *folders('config'),
        *folders('launch'),
        *folders('rviz'),
        *folders('foxglove'),
    ],
    entry_points={
        'console_scripts': [f'{name} = {target}' for name, target in EXECUTABLES.items()]
    },
    install_requires=['numpy', 'pyyaml'],
    extras_require={
        'ros': [f'ros-jazzy-{name}' for name in WHEELS],
        'ros-kilted': [f'ros-kilted-{name}' for name in WHEELS],
        'fast': [NUMBA, 'tqdm'],
        'mesh': ['trimesh'],
        'terrain': ['rasterio'],
        'bag': ['rosbags>=0.10'],
        'plot': ['matplotlib', 'rosbags>=0.10'],
        'view': ['nicegui>=3.18,<4', 'rosbags>=0.10'],
        'browser': ['playwright'],  # with a Chromium, for the tests of the page in one
        'bench': ['matplotlib', 'mujoco', 'pybullet', 'scipy', 'tqdm'],
        'study': ['matplotlib', 'scipy', 'tqdm'],
        'docs': ['sphinx>=7.2', 'myst-parser', 'sphinx-rtd-theme'],
        'lint': [*LINTERS, 'mypy', 'pydocstyle', 'ruff==0.17.*'],
        'test': [
            'pytest',
            'pytest-xdist',
            'hypothesis',
            'scipy',
            'flake8',
            'import-linter',
            'rosbags>=0.10',
            'trimesh',
            'rasterio',
            'dask[distributed]',
            'nicegui>=3.18,<4',
        ],
    },
    zip_safe=False,
)
