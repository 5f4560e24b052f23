"""Material values and shop rules, each with its source."""
