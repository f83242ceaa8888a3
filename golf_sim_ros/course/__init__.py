# SPDX-License-Identifier: Apache-2.0
"""Courses from YAML files, and the files of meshes, heights and materials that they name."""
from .course_file import CourseError, load_course, load_round, shipped_courses

__all__ = ['CourseError', 'load_course', 'load_round', 'shipped_courses']
