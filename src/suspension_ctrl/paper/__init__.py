"""The experiment of Yuen and Ramli (2010)."""
