"""The manifest of a design folder: what was written, from which spec, by which versions."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from importlib.metadata import version

from springcad import __version__

_PACKAGES = ("ezdxf", "numpy", "scipy", "shapely")
"""The libraries whose version can change the bytes of a drawing."""


def sha256(content: bytes | str) -> str:
    """Hexadecimal SHA-256 of a file's content; text counts as UTF-8."""
    return hashlib.sha256(content.encode() if isinstance(content, str) else content).hexdigest()


def manifest_json(kind: str, name: str, spec_sha256: str, files: Mapping[str, bytes | str]) -> str:
    """Text of ``manifest.json`` for ``files`` (name → content): no clock, no path, sorted keys."""
    manifest = {
        "springcad": __version__,
        "kind": kind,
        "name": name,
        "spec_sha256": spec_sha256,
        "files": {file: sha256(content) for file, content in files.items()},
        "versions": {package: version(package) for package in _PACKAGES},
    }
    return json.dumps(manifest, indent=2, sort_keys=True) + "\n"
