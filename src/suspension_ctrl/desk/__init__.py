"""Decisions for an engineer: studies in files, candidates of a front, designs beside the present one."""
