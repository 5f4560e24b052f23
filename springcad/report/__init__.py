"""Results as people and machines read them: terminal, JSON and HTML."""
