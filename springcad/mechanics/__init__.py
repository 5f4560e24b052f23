"""Pure physics of compliant elements: floats and arrays in, floats and arrays out."""
