# shellcheck shell=sh disable=SC2154 # sourced by gpu.sh
# The report's folder, and steps with limits of time whose results it keeps: parts/NAME/status.json, written last.

now() { date +%s; }
scaled() { awk "BEGIN { printf \"%d\", $1 * $factor + 0.5 }"; } # a limit, as the user has it

# put FILE TEXT: all of it, or a line and the end.
put() {
  if { printf '%s\n' "$2" >"$1.new"; } 2>/dev/null && mv "$1.new" "$1"; then return 0; fi
  rm -f "$1.new"
  stop "$1: cannot be written; is the disk full? What is whole is kept, and the same command goes on"
}

free_kibibytes() { df -Pk "$1" | awk 'NR == 2 { print $4 }'; }
least_free=65536 # kibibytes, at the start

# After a step that failed: was it for want of room?
require_room() {
  free=$(free_kibibytes "$out")
  [ "$free" -ge 1024 ] || stop "$out: the disk is full ($free KiB are free); what is whole is kept, and the same command goes on"
}

# A field of a status, which is one line, and one of who.json, which has a line for each.
field() { sed -n "s/.*\"$2\": \"*\([^\",}]*\).*/\1/p" "$1" 2>/dev/null | head -n 1; }
who_field() { sed -n "s/^  \"$2\": \"*\(.*[^\",]\)\"*,*\$/\1/p" "$1" 2>/dev/null; }

# The folder, new or with what an earlier run left. Who draws is asked each time: another driver or commit is refused.
open_folder() {
  if [ -e "$out" ] && [ ! -d "$out" ]; then stop "$out: is no folder"; fi
  mkdir -p "$out" 2>/dev/null || stop "$out: cannot be made"
  out=$(cd "$out" && pwd)
  folder=$out/parts
  if [ -n "$(ls -A "$out")" ] && [ ! -d "$folder" ] && [ ! -f "$out/details.tar.gz" ]; then
    stop "$out: is not empty, and holds no report of gpu.sh"
  fi
  if [ ! -w "$out" ]; then stop "$out: cannot be written"; fi
  [ "$(free_kibibytes "$out")" -ge $least_free ] ||
    stop "$out: $(free_kibibytes "$out") KiB are free there, and $least_free are needed"
  if [ ! -d "$folder" ] && [ -f "$out/details.tar.gz" ]; then
    tar -xzf "$out/details.tar.gz" -C "$out" || stop "$out/details.tar.gz: cannot be unpacked"
  fi
  ask_who
  refuse_others
  mkdir -p "$folder"
  exec 9>"$folder/lock"
  flock -n 9 || stop "$out: another gpu.sh works on it"
}

ask_who() {
  if ! run_limited 30 "$scratch/who.log" TERM "$bin/tyndall-gpu" who --out "$scratch/who.json"; then
    [ "$status" -ne 124 ] && [ "$status" -ne 137 ] || stop "the driver does not give a context within 30 s"
    stop "$(head -n 1 "$scratch/who.log" | sed 's/^tyndall-gpu: //')"
  fi
  sed 's/^tyndall-gpu: //' "$scratch/who.log"
  driver=$(who_field "$scratch/who.json" driver) commit=$(who_field "$scratch/who.json" commit)
  say "$driver, commit $commit"
  software=''
  if [ "$(who_field "$scratch/who.json" software)" = true ]; then
    software=1
    say "NO GPU: this is a SOFTWARE driver. The report is marked so; EGL's devices: $(sed -n 's/^      "name": "\(.*\)",$/\1/p' "$scratch/who.json" | paste -sd ';' -)"
  fi
  if [ -z "$size" ]; then
    size=full
    [ -z "$software" ] || size=quick
  fi
}

refuse_others() {
  known=$folder/a-who/who.json
  [ -f "$known" ] || return 0
  [ "$(who_field "$known" commit)" = "$commit" ] ||
    stop "$out: holds a report of commit $(who_field "$known" commit), and this is $commit; give another --out"
  [ "$(who_field "$known" driver)" = "$driver" ] ||
    stop "$out: holds a report of $(who_field "$known" driver), and this is $driver; give another --out"
  [ "$(cat "$folder/size")" = "$size" ] || stop "$out: was begun with --$(cat "$folder/size"), and this is --$size; give another --out"
}

# begin_part SECONDS: the steps that follow share them.
begin_part() { part_end=$(($(now) + $(scaled "$1"))) over=''; }

# run_limited SECONDS LOG SIGNAL COMMAND...: its exit status in status; 124 or 137 if it was ended.
run_limited() {
  seconds=$1 log=$2 signal=$3
  shift 3
  timeout -k 10 -s "$signal" "$seconds" "$@" >>"$log" 2>&1 9>&- &
  running=$!
  status=0
  wait "$running" || status=$?
  running=''
  return "$status"
}

# step NAME TITLE SECONDS SIGNAL COMMAND...: runs it in parts/NAME unless there is a result, and keeps what became of it.
step() {
  name=$1 title=$2 limit=$(scaled "$3") signal=$4 at=$folder/$1
  shift 4
  if is_settled; then
    say "$title: kept"
    return 0
  fi
  mkdir -p "$at"
  left=$((part_end - $(now)))
  [ "$left" -ge "$limit" ] || limit=$left
  if [ "$limit" -lt 1 ]; then
    put "$at/status.json" "{\"title\": \"$title\", \"result\": \"not begun\"}"
    [ -n "$over" ] || say "$title: not begun, nor what follows: the time of its part is over"
    over=1
    return 0
  fi
  rm -f "$at/status.json"
  : 2>/dev/null >"$at/log" || require_room
  start=$(now)
  run_limited "$limit" "$at/log" "$signal" "$@" || :
  took=$(($(now) - start))
  case $status in
  0) result=done ;;
  124 | 137) result=killed ;;
  *) result=failed && require_room ;;
  esac
  put "$at/status.json" "{\"title\": \"$title\", \"result\": \"$result\", \"exit\": $status, \"seconds\": $took, \"limit\": $limit}"
  said=$result
  [ "$result" != killed ] || said="ended at its limit of $limit s"
  [ "$result" != failed ] || said="FAILED ($status): $(tail -n 1 "$at/log")"
  say "$title: $said, $took s"
}

# What was ended at a limit may be run again with a longer one.
is_settled() {
  case $(field "$at/status.json" result) in
  done) return 0 ;;
  failed) [ -z "$again" ] ;;
  killed) [ -z "$again" ] && [ "$(field "$at/status.json" limit)" -ge "$limit" ] ;;
  *) return 1 ;;
  esac
}

# The report of what there is.
write_report() {
  "$bin/tyndall-gpu" report "$out" || {
    require_room
    stop "$out: the report cannot be written"
  }
}

# The report, its plots, and all that the tools wrote in one file: few files, all of them whole.
close_folder() {
  write_report
  if [ -n "$(plotting_python)" ]; then
    draw_plots "$out" || say "The plots could not be drawn"
  else
    say "No plots: python3 with matplotlib is not here. Draw them later: sh gpu.sh --plots $out"
  fi
  rm -f "$folder/lock"
  if tar -czf "$out/details.new" -C "$out" parts 2>/dev/null && mv "$out/details.new" "$out/details.tar.gz"; then
    rm -rf "$folder"
  else
    rm -f "$out/details.new"
    stop "$out/details.tar.gz: cannot be written; is the disk full? The report is whole, and $folder has its details"
  fi
  [ -z "$software" ] || say "SOFTWARE driver: no GPU was measured"
  say "Done: $out/report.md"
}
