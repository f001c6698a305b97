# shellcheck shell=sh disable=SC2154 # sourced by gpu.sh
# The parts of a report, each with its limit of time, what tells most first: eight minutes together.

jobs=$(nproc 2>/dev/null || echo 1)
[ "$jobs" -le 12 ] || jobs=12
ours=exact,high,balanced,performance

# Sizes of pictures and maps, and rivals: a GPU's, or small ones and few.
set_sizes() {
  rivals=fixed:16,fixed:64,half:16,half:64,froxels:64,epipolar-march:512,tree:512,pyramid
  if [ "$size" = full ]; then
    rivals=$rivals,fixed:256,half:256,froxels:128,epipolar-march:1024,lowrank:4,volumes:1024,incremental:512
    goal_size=2560x1600 goal_map=4096 more_sizes="1920x1080 3840x2160" sequence_size=1920x1080 frames=0-71 avsm_size=256 avsm_runs=10 avsm_scenes="smoke hair"
  else
    goal_size=320x200 goal_map=1024 more_sizes="240x150 480x300" sequence_size=320x180 frames=0-11 avsm_size=64 avsm_runs=2 avsm_scenes="smoke-tenth hair-tenth"
  fi
}

# (a) Who draws.
part_who() {
  begin_part 15
  is_new=''
  [ -f "$folder/a-who/who.json" ] || is_new=1
  step a-who "Who draws" 5 TERM cp "$scratch/who.json" "$folder/a-who/who.json"
  [ -z "$is_new" ] || put "$folder/size" "$size"
  if command -v nvidia-smi >/dev/null; then
    step a-who-clocks "Clocks" 10 TERM sh -c 'nvidia-smi -q -d CLOCK,POWER,TEMPERATURE,PERFORMANCE >"$0/nvidia-smi"' "$folder/a-who-clocks"
  fi
}

# bench NAME TITLE SECONDS OPTION...: a run of tyndall-bench, which ends in order at SIGINT.
bench() {
  name=$1 title=$2 seconds=$3
  shift 3
  step "$name" "$title" "$seconds" INT "$bin/tyndall-bench" --contexts egl --runs 20 --out "$folder/$name" "$@"
}

# (d) first: what is wanted of a GPU.
part_goals() {
  set_sizes
  begin_part 80
  bench d-01-nave "Goals: nave $goal_size, map $goal_map" 45 --scenes nave --techniques $ours --sizes "$goal_size" \
    --shadow-sizes "$goal_map" --floors --calls --run-seconds 3
  bench d-02-stage-spot "Goals: one spot of stage $goal_size, map $goal_map" 40 --scenes stage --lights 1 --techniques $ours \
    --sizes "$goal_size" --shadow-sizes "$goal_map" --calls --run-seconds 3
  write_report
}

# (b) The tests on this driver, its compiler, and exact against map-exact on every sample scene.
part_tests() {
  begin_part 130
  step b-tests "Tests, each by itself" 70 TERM "$bin/tyndall-gpu" cases "$bin/tyndall-gl-tests" --out "$folder/b-tests" --jobs "$jobs"
  step b-programs "Every program, compiled" 60 TERM env MESA_SHADER_CACHE_DISABLE=true __GL_SHADER_DISK_CACHE=0 \
    "$bin/tyndall-gpu" programs --out "$folder/b-programs/programs.json"
  step b-accuracy "exact against map-exact, every scene" 45 TERM "$bin/tyndall-gpu" cases "$bin/tyndall-render-tests" \
    --select "exact equals map-exact on every sample scene*" --case-seconds "$(scaled 45)" --out "$folder/b-accuracy"
  write_report
}

# (c) Pictures against those of OSMesa, or where there is none those that the project keeps.
part_pictures() {
  begin_part 60
  if [ -z "$references" ]; then
    references=$folder/c-references
    step c-references "References by OSMesa" 40 TERM "$bin/tyndall-regress" record "$cases" --scenes "$scenes" \
      --references "$references" --context osmesa --jobs "$jobs"
    # Without OSMesa, and where its time was not enough, the kept ones stand in.
    for file in "$here"/../samples/regress/references/*; do
      [ -e "$references/${file##*/}" ] || cp "$file" "$references/"
    done
  fi
  # What differs is a result.
  # shellcheck disable=SC2016 # the inner shell expands it
  step c-pictures "Pictures against references" 60 TERM sh -c '"$@" || [ $? -eq 1 ]' sh "$bin/tyndall-regress" check "$cases" \
    --scenes "$scenes" --references "$references" --out "$folder/c-pictures" --context egl --jobs "$jobs" --timeout 60 --resume
  write_report
}

# (d) Run time against error: every scene and the rivals, then how it grows, then other sizes.
part_time() {
  set_sizes
  begin_part 150
  for scene in nave stage nave-glass forest terrain cage concert projector; do
    bench "d-10-$scene" "Run time: $scene $goal_size, map $goal_map" 30 --scenes $scene --techniques $ours,$rivals \
      --sizes "$goal_size" --shadow-sizes "$goal_map" --calls --run-seconds 0.4
  done
  bench d-20-scaling "Scaling of map and pixels" 30 --series shadow,image --run-seconds 0.2
  for other in $more_sizes; do
    for scene in nave stage nave-glass forest terrain cage concert projector; do
      bench "d-30-$other-$scene" "Run time: $scene $other, map $goal_map" 20 --scenes $scene \
        --techniques $ours,fixed:64,half:64,froxels:64 --sizes "$other" --shadow-sizes "$goal_map" --run-seconds 0.3
    done
  done
  write_report
}

# (e) Temporal reuse, smoke and hair.
part_motion() {
  set_sizes
  begin_part 45
  for scene in pendulum orrery sweep; do
    # shellcheck disable=SC2016 # the inner shell expands it
    step "e-reuse-$scene" "Reuse: $scene" 12 TERM sh -c 'to=$1 && shift && exec "$@" >"$to"' sh "$folder/e-reuse-$scene/sequence.csv" \
      "$bin/tyndall-sequence" "$scenes/$scene.glb" --frames $frames --size "$sequence_size" \
      --shadow-size "$goal_map" --context egl
  done
  for scene in $avsm_scenes; do
    step "e-avsm-$scene" "Smoke and hair: $scene" 12 TERM "$bin/tyndall-avsm-bench" --scenes $scene --size $avsm_size \
      --runs $avsm_runs --context egl --csv "$folder/e-avsm-$scene/avsm.csv"
  done
}
