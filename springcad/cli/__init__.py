"""The command line: one module per command, no numerics, heavy imports inside the commands."""
