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

"""How to install a library that only some tools need, said where it is missing."""

# What apt has, on Ubuntu from 22.04 and Debian from 12; rosdep installs it with the rest of
# package.xml.
APT = {
    'matplotlib': 'python3-matplotlib',
    'scipy': 'python3-scipy',
    'tqdm': 'python3-tqdm',
    'rasterio': 'python3-rasterio',
}


def how_to_get(extra: str, *libraries: str) -> str:
    """Ways to install `libraries`, all of which the pip extra `extra` of this package brings."""
    by_pip = f"pip install 'golf_sim_ros[{extra}]'"
    if not APT.keys() >= set(libraries):
        return f'{by_pip} (in a virtual environment; apt has no {" and no ".join(libraries)})'
    packages = ' '.join(APT[library] for library in libraries)
    return f'sudo apt install {packages}, or {by_pip} (in a virtual environment)'
