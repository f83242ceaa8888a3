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

"""How Sphinx makes one book of docs/*.md and the docstrings: `make docs`, and `rosdoc2 build`.

Both copy this folder to another one, add pages of the modules by sphinx-apidoc, and build there.
So nothing here may depend on where this file lies.
"""

from pathlib import Path
import re
import sys
from types import SimpleNamespace
from xml.etree import ElementTree

try:
    import golf_sim_ros
except (
    ImportError
):  # rosdoc2 executes this file from a conf.py of its own, which says where this one is
    executed = re.search(
        r'^exec\(open\("(.*)"\)', Path(__file__).read_text(encoding='utf-8'), re.MULTILINE
    )
    sys.path.insert(0, str(Path(executed[1]).parents[1]))
    import golf_sim_ros
from golf_sim_ros.course.package_files import share

project = 'golf_sim_ros'
author = 'golf_sim_ros maintainers'
copyright = f'{author}, Apache-2.0'  # noqa: A001
version = release = golf_sim_ros.__version__

extensions = ['myst_parser', 'sphinx.ext.autodoc', 'sphinx.ext.napoleon']
source_suffix = {'.md': 'markdown', '.rst': 'restructuredtext'}
# What rosdoc2 adds: an index where index.md is, and the texts of the repository's root, to which
# links lead.
exclude_patterns = ['index.rst', '__readme_include.rst', 'standards.rst', 'standard_docs']
myst_heading_anchors = 3
html_theme = 'sphinx_rtd_theme'
suppress_warnings = ['ref.python']  # a record that a package passes on is found in two places

# The packages of ROS, of drawing and of speed are not needed to read docstrings.
autodoc_mock_imports = [
    'rclpy',
    'rcl_interfaces',
    'std_msgs',
    'std_srvs',
    'geometry_msgs',
    'visualization_msgs',
    'diagnostic_msgs',
    'rosgraph_msgs',
    'tf2_msgs',
    'builtin_interfaces',
    'nicegui',
    'fastapi',
    'numba',
    'llvmlite',
    'rosbags',
    'trimesh',
    'rasterio',
    'matplotlib',
    'scipy',
    'tqdm',
]


class Element:
    """Stand-in for NiceGUI's, whose subclasses take keywords; autodoc's own would refuse them."""

    def __init_subclass__(cls, **_):
        pass


sys.modules['nicegui.element'] = SimpleNamespace(Element=Element, __spec__=None)
autodoc_member_order = 'bysource'
napoleon_google_docstring = False
napoleon_use_rtype = False


def repository():
    """Address of the repository, as package.xml has it."""
    urls = {
        url.get('type'): url.text for url in ElementTree.parse(share('package.xml')).iter('url')
    }
    return urls['repository']


def link_to_the_repository(app, docname, source):
    """Lead links out of this folder to the repository.

    They serve who reads it in a checkout.
    """
    source[0] = source[0].replace('](../', f']({repository()}/blob/main/')


def leave_out(app, what, name, member, skip, options):
    """Leave out fields of named tuples, which the record tells, and errors told elsewhere.

    An error that a package passes on would have two pages, which Sphinx refuses.
    """
    if type(member).__name__ == '_tuplegetter':
        return True
    is_error = isinstance(member, type) and issubclass(member, Exception)
    return True if is_error and member.__module__ != app.env.temp_data['autodoc:module'] else None


def as_written(app, what, name, thing, options, lines):
    """Let drawings in docstrings be literal, and |u| the size of u; reST means something else."""
    literal, wanted = False, []
    lines[:] = [re.sub(r'(?<!`)`(\w+)`s\b', r'``\1``\\ s', line) for line in lines]  # `Element`s
    for before, line in zip(['', *lines], lines):
        indented = line.startswith('     ')
        if line and not line.startswith(' '):
            literal = line.endswith('::')
        elif indented and not literal and not before and any('|' in other for other in lines):
            wanted += ['::', '']
            literal = True
        wanted.append(line if literal else re.sub(r'(?<!`)\|', r'\\|', line))
    lines[:] = wanted


def setup(app):
    """Connect what is above to Sphinx."""
    app.connect('source-read', link_to_the_repository)
    app.connect('autodoc-skip-member', leave_out)
    app.connect('autodoc-process-docstring', as_written)
