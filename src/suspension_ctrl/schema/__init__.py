"""Files by the fields of frozen dataclasses: their keys, reading with all mistakes at once, and writing."""
