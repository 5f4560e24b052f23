"""The independent second look: written files are read again and judged as a shop would."""
