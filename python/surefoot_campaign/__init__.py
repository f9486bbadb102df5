"""Campaigns: a grid or a random draw of scenario parameters, times seeds, each run in a process of its own.

spec      reads the file that says what to run
plan      turns it into runs, each with its id, and lets the program check them
scheduler runs them, some at a time
journal   keeps one line a finished run, so that a campaign that was killed goes on
results   the table of all runs: CSV and Parquet
statistics, plots, report   what the table says
"""
