"""Drawings, atomic writing of files, and the manifest."""
