"""The report of a run: one HTML page, and its figures as SVG and PDF, from the log alone.

run_data, outside_forces, outcome   what the report shows of a log
plotting                            how its figures look
motion_figures, space_figure, ground, hierarchy_figures, timing_figure   the figures
page, head, numbers, blockers       the page around them
report                              all of it into a folder
"""
