"""Many runs, each in a process of its own: campaigns (a grid or a random draw of scenario parameters, times seeds),
`run --seeds` and the demo.

program    the program, and what it says of a run before it begins
scheduler  runs tasks, some at a time
outcome    what became of a run
statistics rates with their intervals, median and worst
text, units   names, metrics and tables as people read them
output_files  files and folders that are this call's alone

Of campaigns:
spec       reads the file that says what to run
plan       turns it into runs, each with its id, and lets the program check them
journal    keeps one line a finished run, so that a campaign that was killed goes on
results    the table of all runs: CSV and Parquet
plots, report   what the table says

Of `run --seeds` and the demo:
seeds      the runs of one scenario, and what they come to
demo, demo_page, experiments  the paper's experiments
"""
