# Output: summary, history, snapshots, checkpoints, progress, report (included by coupling/CMakeLists.txt)
set(COUPLING_OUTPUT_SOURCES io/checkpoint.c io/hdf5_file.c io/history.c io/outdir.c io/progress.c io/report.c
                            io/report_gnuplot.c io/report_map.c io/report_page.c io/report_plots.c
                            io/report_plots_study.c io/report_study.c io/snapshot.c io/snapshot_mpm.c io/scene_result.c io/stop.c io/summary.c
                            io/summary_keys.c io/summary_print.c io/table.c)
