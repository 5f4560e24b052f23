"""springcad designs compact compliant elements for robot joints: a YAML spec in, cut files out.

The version stands here and nowhere else. Importing the package loads nothing heavy.
"""

__version__ = "0.1.0"
