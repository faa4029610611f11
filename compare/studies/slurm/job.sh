#!/bin/bash
# properties = {properties}
# How the job ended, for when the controller has forgotten it; nothing is left where it was killed.
ended=.snakemake/slurm/$SLURM_JOB_ID.ended
rm -f "$ended"
trap 'echo $? >"$ended"' EXIT
# A run is on one node: mpirun, where it sees Slurm, would ask it to start the processes.
unset ${{!SLURM_@}}
{exec_job}
