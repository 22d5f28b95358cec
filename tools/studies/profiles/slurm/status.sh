#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Says running, success or failed of a job of Slurm, as Snakemake asks:  status.sh JOB
# and, of one that has failed, why, to stderr. scontrol knows a job for some minutes after its end;
# sacct, where there is accounting, for ever. A job that neither knows has ended, and nobody can say
# how: it is failed, and what its runs have left counts in any case.
job=${1%%;*}
patience_min=60 # of a Slurm that does not answer
mark=.slurm_silent_$job

failed() {
  echo "status.sh: job $job: $1" >&2
  rm -f "$mark"
  echo failed
  exit 0
}

told=$(scontrol show job "$job" 2>&1)
state=$(sed -n 's/.*JobState=\([A-Z_]*\).*/\1/p' <<<"$told" | head -n 1)
if [ -z "$state" ]; then
  more=$(sacct -X -n -P -o State -j "$job" 2>&1)
  state=$(grep -oE '^[A-Z_]+' <<<"$more" | tail -n 1)
fi
if [ -z "$state" ]; then
  silence='[Uu]nable to contact|[Tt]imed out|timeout|[Cc]onnection|[Cc]ommunication|not respond'
  if grep -qE "$silence" <<<"$told" && ! grep -q 'Invalid job id' <<<"$told"; then
    [ -e "$mark" ] || : >"$mark"
    [ -z "$(find "$mark" -mmin +$patience_min 2>/dev/null)" ] ||
      failed "Slurm has not answered for $patience_min minutes"
    echo running
    exit 0
  fi
  failed "neither scontrol nor sacct knows it any more"
fi
rm -f "$mark"
case $state in
  COMPLETED) echo success ;;
  PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | SIGNALING | STAGE_OUT | RESIZING) echo running ;;
  REQUEUED | REQUEUE_FED | POWER_UP_NODE | UPDATE_DB | EXPEDITING) echo running ;;
  REQUEUE_HOLD | SPECIAL_EXIT | RESV_DEL_HOLD) failed "$state: it is held until somebody releases it" ;;
  STOPPED) failed "STOPPED: its processes have been stopped, and go on only when somebody tells them to" ;;
  *) failed "$state" ;;
esac
