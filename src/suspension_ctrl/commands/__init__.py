"""The commands of the terminal: parse, call, print, save."""
