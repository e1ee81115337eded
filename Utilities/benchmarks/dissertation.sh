# SPDX-License-Identifier: BSD-3-Clause
# dissertation [--points N] [--ranks "1 2"] [--table NAME]
#   The experiments of the dissertation's chapters 2 and 3 (Documentation/Reproduction.md).
#   --points N  points of the largest uniform set (10000000)
#   --ranks     numbers of ranks ("1 2")
#   --table     one of table2.1 figure3.4 figure3.6 figure3.5 figure3.8 model (default: all)
points=10000000
ranks="1 2"
table=all

while [ $# -gt 0 ]; do
  case $1 in
    --points | --ranks | --table)
      [ $# -gt 1 ] || usage
      case $1 in
        --points) points=$2 ;;
        --ranks) ranks=$2 ;;
        --table) table=$2 ;;
      esac
      shift
      ;;
    *) usage ;;
  esac
  shift
done

case " all table2.1 figure3.4 figure3.6 figure3.5 figure3.8 model " in
  *" $table "*) ;;
  *) usage ;;
esac

build_targets tipp benchmarkOrder
tipp=$build/bin/tipp
work=$build/dissertation
mkdir -p "$work"
most=1
for n in $ranks; do
  [ "$n" -le "$most" ] || most=$n
done
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

wanted() { [ "$table" = all ] || [ "$table" = "$1" ]; }

# Makes an input unless it exists. An unfinished file has another name.
make_points() { # NAME OPTION...
  name=$1
  shift
  [ -f "$inputs/$name.npy" ] && return
  "$tipp" points "$@" -o "$inputs/unfinished.npy" >/dev/null
  mv "$inputs/unfinished.npy" "$inputs/$name.npy"
}

# Runs on ranks of one thread each, and stores the figures under the label.
on_ranks() { # LABEL RANKS INPUT OPTION...
  label=$1
  number=$2
  input=$3
  shift 3
  mpirun --oversubscribe --bind-to none -np "$number" "$tipp" delaunay "$inputs/$input.npy" \
    -o "$work/triangles.npy" --threads 1 --stats "$work/$label.json" "$@" >/dev/null
  /usr/bin/python3 Testing/Benchmarks/rank_row.py "$label" "$work/$label.json"
}
head_row() { /usr/bin/python3 Testing/Benchmarks/rank_row.py head; }

make_points "uniform-$points" --distribution uniform --count "$points"

if wanted table2.1; then
  echo "== Table 2.1: partitions active in the first stage (dissertation: 4 16 61 251 1020)"
  for initial in 8 64 256; do
    for n in 4 8 16 32 64; do
      "$tipp" delaunay "$inputs/uniform-$points.npy" -o "$work/triangles.npy" --partitions "${n}x$n" \
        --initial-points "$initial" --schedule stages --stats "$work/stages.json" >/dev/null
      /usr/bin/python3 -c "import json, sys
active = json.load(open(sys.argv[1]))['stages'][0]['active_partitions']
print(int(sys.argv[2]) ** 2, 'partitions,', sys.argv[3], 'initial points in each:', active)" \
        "$work/stages.json" "$n" "$initial"
    done
  done
fi
if wanted figure3.4; then
  echo "== Figures 2.11 and 3.4: granularity, $most ranks"
  head_row
  for size in $((points / 10)) "$points"; do
    make_points "uniform-$size" --distribution uniform --count "$size"
    for n in 4 8 16 32 64 128; do
      on_ranks "$size-single-${n}x$n" "$most" "uniform-$size" --masters single --minor "${n}x$n"
    done
    for n in 4 8 16; do
      on_ranks "$size-multi-8x8-${n}x$n" "$most" "uniform-$size" --masters multi --major 8x8 \
        --minor "${n}x$n"
    done
  done
fi
if wanted figure3.6; then
  echo "== Figures 2.12, 2.13 and 3.6: ranks"
  head_row
  for n in $ranks; do
    on_ranks "$n-ranks-single" "$n" "uniform-$points" --masters single
    on_ranks "$n-ranks-multi" "$n" "uniform-$points" --masters multi
  done
fi
if wanted figure3.5; then
  echo "== Figure 3.5 and table 3.1: one master and several, 4,096 partitions, $most ranks"
  head_row
  on_ranks 4096-single "$most" "uniform-$points" --masters single --minor 64x64
  on_ranks 4096-multi "$most" "uniform-$points" --masters multi --major 8x8 --minor 8x8
fi
if wanted figure3.8; then
  mesh=$data/adcirc/ec95d/ec95d.grd
  if [ -f "$mesh" ]; then
    echo "== Figure 3.8: points like EC95d"
    make_points "ec95d-$points" --like "$mesh" --count "$points"
    head_row
    for n in $ranks; do
      on_ranks "ec95d-$n-single-stages" "$n" "ec95d-$points" --masters single --minor 32x32 \
        --schedule stages --groups equal
      on_ranks "ec95d-$n-producer-consumer" "$n" "ec95d-$points" --masters single --minor 32x32 \
        --schedule producer-consumer --groups equal
      on_ranks "ec95d-$n-multi-plain" "$n" "ec95d-$points" --masters multi --major 4x4 \
        --minor 8x8 --schedule stages --groups equal
      on_ranks "ec95d-$n-multi-adaptive" "$n" "ec95d-$points" --masters multi --major 4x4 \
        --minor auto:16384
      on_ranks "ec95d-$n-multi-tree" "$n" "ec95d-$points" --masters multi
      on_ranks "ec95d-$n-single-tree" "$n" "ec95d-$points" --masters single
    done
  else
    echo "benchmark.sh: no $mesh: figure 3.8 is left out; name the data by TIPP_SHARED_DATA." >&2
  fi
fi
if wanted model; then
  echo "== Cluster model, without a master"
  clusters="$ranks 64"
  [ "$points" -lt 50000000 ] || clusters="$clusters 1024"
  for n in $clusters; do
    "$build/bin/benchmarkOrder" "$inputs/uniform-$points.npy" "$n" >"$work/order-$n.trace"
  done
  for n in $ranks; do
    on_ranks "model-$n" "$n" "uniform-$points" >/dev/null
  done
  (
    cd "$work"
    # shellcheck disable=SC2046
    /usr/bin/python3 "$top/Testing/Benchmarks/cluster_model.py" --costs "model-${ranks%% *}.json" \
      --check $(printf 'model-%s.json ' $ranks) -- $(printf 'order-%s.trace ' $clusters)
  )
fi
