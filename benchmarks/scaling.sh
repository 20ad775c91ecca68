#!/usr/bin/env bash
#SBATCH --job-name=cleft-scaling
#SBATCH --exclusive
# scaling.sh [OUT [ELEMENT_SIZE [NU]]]: strong and weak scaling of frames by iterations, from one rank to all in powers of
# two: OUT.csv and its chart OUT.svg. On a cluster: sbatch -N NODES -n RANKS benchmarks/scaling.sh. Elsewhere
# RANKS ranks (default 2) of this machine are used. BUILD is the folder of the build, LAUNCH the command before
# the number of ranks.
set -eu
here=$(cd "$(dirname "${CLEFT_BENCHMARKS:-$0}")" && pwd)
if [ -n "${SLURM_JOB_ID:-}" ]; then here=${CLEFT_BENCHMARKS:-$SLURM_SUBMIT_DIR/benchmarks}; fi
out=${1:-scaling} size=${2:-1} nu=${3:-0.3}
program=${BUILD:-$here/../build/release}/bin/cleft-benchmark-scaling
most=${SLURM_NTASKS:-${RANKS:-2}}
launch=${LAUNCH:-$([ -n "${SLURM_JOB_ID:-}" ] && echo srun --mpi=pmix --cpu-bind=cores -n || echo mpirun --bind-to none -n)}
rows=$(mktemp); trap 'rm -f "$rows"' EXIT
for kind in strong weak; do
  for ((ranks = 1; ranks <= most; ranks *= 2)); do
    lengths=1; if [ $kind = weak ]; then lengths=$ranks; fi
    $launch $ranks "$program" "$size" 1 "$nu" "$lengths" | sed "1s/^/kind,/; 2s/^/$kind,/" > "$rows.one"
    [ -s "$rows" ] || head -1 "$rows.one" > "$rows"
    tail -1 "$rows.one" | tee -a "$rows"
    rm -f "$rows.one"
  done
done
cat "$rows" > "$out.csv"
python3 "$here/scaling_chart.py" "$out.csv" "$out.svg"
