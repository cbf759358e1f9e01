"""Roads: spectra, coherence of tracks, profiles, measured and from files."""
