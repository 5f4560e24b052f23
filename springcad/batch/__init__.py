"""Running designs: one spec the whole way, and many specs one after another."""
