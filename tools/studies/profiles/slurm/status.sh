#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Says running, success or failed of a job of Slurm, as Snakemake asks:  status.sh JOB
# scontrol knows a job for some minutes after its end; sacct, where there is accounting, for ever.
state=$(scontrol show job "$1" 2>/dev/null | sed -n 's/.*JobState=\([A-Z_]*\).*/\1/p')
[ -n "$state" ] || state=$(sacct -X -n -P -o State -j "$1" 2>/dev/null | head -n 1)
case $state in
  COMPLETED*) echo success ;;
  BOOT_FAIL* | CANCELLED* | DEADLINE* | FAILED* | NODE_FAIL* | OUT_OF_MEMORY* | PREEMPTED* | TIMEOUT*) echo failed ;;
  *) echo running ;;
esac
