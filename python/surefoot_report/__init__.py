"""The report of a run: one HTML page, and its figures as SVG and PDF, from the log alone.

run_data, outcome               what the report shows of a log
plotting                        how its figures look
motion_figures, space_figure, ground, hierarchy_figures   the figures
page, head, numbers, blockers   the page around them
report                          all of it into a folder
"""
