"""The sections of the benchmark: each measures and returns a table, `report` puts them together."""
