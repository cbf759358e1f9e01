"""A vehicle on a road: mean squares of its responses, measures, the ride problem; driving in time."""
