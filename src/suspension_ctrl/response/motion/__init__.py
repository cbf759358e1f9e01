"""Vehicles with struts of any kind in time: equations of motion and their integration."""
