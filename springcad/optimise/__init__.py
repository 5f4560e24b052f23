"""Multi-start constrained minimisation: seeded, counted in starts, never in seconds."""
