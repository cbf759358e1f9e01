"""Abuse in bulk: what users, machines and other programs do to files and processes."""
