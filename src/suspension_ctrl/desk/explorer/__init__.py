"""The explorer, one file for a browser: its record of a study, its numerics in JavaScript, its page."""
