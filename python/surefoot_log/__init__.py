"""Logs of runs, for other programs and for the eye.

log_file          reads a log as far as it goes
channels, table   its fields as columns: CSV and Parquet
foxglove*         its scene for Foxglove and Lichtblick
frames, moments   what of a run is shown, and when
meshes, urdf_visuals, scene, overlays, camera, captions, painter   pictures without a screen
strip, clip, pictures   sequences of them
"""
