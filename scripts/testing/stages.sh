# Sourced by scripts/test: runs stages, keeps their logs, counts their cases and the processor time of all that they start
# (scripts/testing/metered), and compares it with tests/suites/budgets.txt.
# Expects: logs (a folder), tier. Sets: passed, failed.

names=() times=() processors=() measures=() results=() failures=() passed=0 failed=0
budgets=${budgets:-tests/suites/budgets.txt}
total_budget=3000  # [s of processors] of the tier merge
own=scripts/testing

# note_speed: keeps the seconds that a core takes now for three million additions of awk: what the times of a run are read by,
# for machines and their other guests differ.
note_speed() {
  TIMEFORMAT=%U
  { time awk 'BEGIN {for (i = 0; i < 3000000; ++i) sum += i}'; } 2>>"$logs/core-speed.txt"
}
# failed_lines LOG: what it says of cases that failed: GoogleTest's lines, with the place, and those of our own checks.
failed_lines() { grep -aE '^ *(FAILED|FAIL) |^\[  FAILED  \]|: Failure$|^ *Expected|^ *Actual|^  Which' "$1" | sort -u | cut -c1-300 | head -20; }

# name_of STAGE: as a person reads it. STAGE may be a suite, like 60-a-tour.
name_of() { basename "$1" | sed 's/^[0-9]*-//; s/-/ /g'; }
# rows TIER HOW: the stages of budgets.txt that are of this tier and run so, those with the largest budgets first.
rows() { awk -v tier="$1" -v how="$2" '!/^#/ && NF && ($1 == tier || $1 == "both") && $2 == how {print $4, $3}' "$budgets" | sort -k1,1nr -k2 | cut -d' ' -f2; }
# budget_of STAGE: seconds, or nothing.
budget_of() { awk -v stage="$1" '!/^#/ && $3 == stage {print $4; exit}' "$budgets"; }

# record STAGE LOG STATUS SECONDS METER: counts what a stage said. The last line "P passed, F failed" of its log, or
# ctest's closing line, says how many cases it had; a log without either is one case.
record() {
  local name=$1 file=$2 status=$3 p="" f=0 all processor=0 measure=none
  if grep -aqE '[0-9]+ passed, [0-9]+ failed' "$file"; then
    read -r p f < <(grep -aoE '[0-9]+ passed, [0-9]+ failed' "$file" | tail -1 | sed -E 's/([0-9]+) passed, ([0-9]+) failed/\1 \2/')
  elif grep -aqE 'tests failed out of [0-9]+' "$file"; then
    read -r f all < <(grep -aoE '[0-9]+ tests failed out of [0-9]+' "$file" | tail -1 | sed -E 's/([0-9]+) tests failed out of ([0-9]+)/\1 \2/')
    p=$((all - f))
  elif [ "$status" -eq 0 ]; then
    p=1
  fi
  p=${p:-0}
  [ "$status" -ne 0 ] && [ "$f" -eq 0 ] && f=1
  [ -f "$5" ] && read -r processor measure <"$5"
  passed=$((passed + p)); failed=$((failed + f))
  names+=("$name"); times+=("$4"); processors+=("$processor"); measures+=("$measure"); results+=("$p passed, $f failed")
  if [ "$status" -ne 0 ]; then
    echo "-- $(name_of "$name") failed (exit $status); what failed, and the end of its log:"
    failed_lines "$file"
    tail -40 "$file"
    failures+=("$(name_of "$name")" "$file")
  fi
  grep -a '^skipped:' "$file" | sort -u || true
}

# stage STAGE COMMAND…: runs it, keeps its log, counts it.
stage() {
  local name=$1 start=$SECONDS file="$logs/$1" status=0
  shift
  echo "== $(name_of "$name")"
  "$own/metered" "$file.meter" "$@" >"$file.log" 2>&1 </dev/null || status=$?
  record "$name" "$file.log" $status $((SECONDS - start)) "$file.meter"
  note_speed
}

# aside STAGE COMMAND…: runs it without counting it yet; `count_aside` does.
aside() {
  local start=$SECONDS file="$logs/$1" status=0
  shift
  "$own/metered" "$file.meter" "$@" >"$file.log" 2>&1 </dev/null || status=$?
  echo "$status $((SECONDS - start))" >"$file.end"
}
count_aside() {
  local status seconds
  read -r status seconds <"$logs/$1.end"
  record "$1" "$logs/$1.log" "$status" "$seconds" "$logs/$1.meter"
}

# lanes SUITE…: suites of simulations, as many at a time as there are processors, each on one: whichever takes longest, no
# processor waits for it. Their times overlap.
lanes() {
  [ $# -gt 0 ] || return 0
  export logs own DOCENT_JOBS=1
  export -f aside note_speed
  echo "== simulations: $(for suite in "$@"; do name_of "$suite"; done | paste -sd, | sed 's/,/, /g')"
  printf '%s\n' "$@" | xargs -P "$(nproc)" -I{} bash -c 'aside {} tests/suites/{}; note_speed'
  local suite
  for suite in "$@"; do count_aside "$suite"; done
}

# beside SUITE…: begins them, one after the other and with the least priority: they wait for nothing, while robots and
# browsers mostly wait for the clock. `finish` counts them when they have ended; their times overlap with the others'. Linux
# may weigh sessions rather than processes: theirs is one of its own, and idle.
beside=()
beside() {
  [ $# -gt 0 ] || return 0
  local idle='echo 19 2>/dev/null >/proc/self/autogroup; exec nice -n 19 chrt --idle 0 "$@"'
  beside=("$@")
  for suite in "$@"; do aside "$suite" setsid --wait bash -c "$idle" idle "tests/suites/$suite"; done &
  beside_id=$!
}
finish() {
  [ ${#beside[@]} -gt 0 ] || return 0
  echo "== what is left of: $(for suite in "${beside[@]}"; do name_of "$suite"; done | paste -sd, | sed 's/,/, /g')"
  wait "$beside_id"
  local suite
  for suite in "${beside[@]}"; do count_aside "$suite"; done
}

# table: the stages with their times, in order, and which of them took more than they may.
table() {
  local i budget over=() sum
  printf '%-40s %8s %10s %7s %-8s  %s\n' stage seconds processor budget measure result
  for i in "${!names[@]}"; do
    budget=$(budget_of "${names[i]}")
    printf '%-40s %8d %10.0f %7s %-8s  %s\n' "$(name_of "${names[i]}")" "${times[i]}" "${processors[i]}" "${budget:--}" "${measures[i]}" "${results[i]}"
    [ -n "$budget" ] && awk -v a="${processors[i]}" -v b="$budget" 'BEGIN {exit !(a > b)}' &&
      over+=("$(printf '%s: %.0f s of processors, over its budget of %s s' "$(name_of "${names[i]}")" "${processors[i]}" "$budget")")
  done
  sum=$(printf '%s\n' "${processors[@]}" | awk '{s += $1} END {printf "%.0f", s}')
  printf '%-40s %8d %10d %7s\n' total "$SECONDS" "$sum" "$([ "$tier" = merge ] && echo $total_budget)"
  [ "$tier" = merge ] && [ "$sum" -gt $total_budget ] && over+=("all together: $sum s of processors, over the budget of $total_budget s")
  [ ${#over[@]} -gt 0 ] && printf '%s\n' "${over[@]}"
  case " ${measures[*]} " in
    *" reaper "*) echo "measure reaper: no control group could be made; orphans were adopted and counted (scripts/testing/metered)" ;;
  esac
  awk '{s += $1; if (NR == 1 || $1 < least) least = $1; if ($1 > most) most = $1}
       END {if (NR) printf "3 million additions of awk took a core %.3f s, %.3f to %.3f, as seen %d times\n", s / NR, least, most, NR}' "$logs/core-speed.txt"
}
