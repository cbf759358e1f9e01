"""Vehicles: masses and links, assembled into a plant with a port for every strut."""
