"""Optimal controllers of vehicles with actuators in place of their struts on wheels, and their measures."""
