# Sourced by scripts/test: what each tier runs. Suites have their tier from tests/suites/budgets.txt.

checks() {
  stage architecture python3 tests/architecture/check_includes.py
  stage sizes python3 tests/architecture/check_sizes.py
  stage documents python3 tests/architecture/check_documents.py
  stage what-the-checks-must-find python3 tests/architecture/checks_test.py
  stage what-the-tiers-choose python3 tests/architecture/tiers_test.py
}

configure() { stage configure scripts/testing/configure; }

# built_and_tested: packages, the build, unit tests, checks: what merge and all have in common. What it takes to build is
# installed first; the rest of the packages come while that is done.
built_and_tested() {
  stage packages scripts/install-packages run build-tests
  aside packages-of-the-tests bash -c 'scripts/install-packages test && { command -v npm >/dev/null || scripts/install-packages run-npm; }' &
  local packages_id=$!
  configure
  stage build cmake --build --preset dev -j "$(nproc)"  # more at a time take longer in all
  wait "$packages_id"
  count_aside packages-of-the-tests
  stage unit-and-replay-tests ctest --preset dev -LE "closed_loop|end_to_end|turtlebot" -j2 --no-tests=error
  checks
}

# suites: those of the tier: some beside the others, some alone, and as many simulations at a time as there are processors.
suites() {
  local suite beside_them lanes
  mapfile -t beside_them < <(rows "$tier" beside)
  mapfile -t lanes < <(rows "$tier" lane)
  beside "${beside_them[@]}"
  for suite in $(rows "$tier" alone | sort); do stage "$suite" "tests/suites/$suite"; done
  lanes "${lanes[@]}"
  finish
  stage nothing-is-left-running scripts/testing/left-running
}

tier_merge() {
  built_and_tested
  suites
}
tier_all() {
  built_and_tested
  suites
}

# build_and_test_folders: the tests of `folders` and what is in `targets`, of tier_quick.
build_and_test_folders() {
  local tests=""
  configure
  if [ ${#folders[@]} -gt 0 ]; then
    printf 'folders: %s\n' "${folders[*]}"
    tests=$(scripts/testing/changes.py tests "${folders[@]}")
    mapfile -t -O ${#targets[@]} targets < <(echo docent; cut -d' ' -f1 <<<"$tests" | sed '/^$/d')
  fi
  mapfile -t targets < <(printf '%s\n' "${targets[@]}" | sort -u)
  stage build cmake --build --preset dev -j "$(nproc)" --target "${targets[@]}"
  [ -z "$tests" ] ||
    GTEST_FILTER=$(scripts/testing/changes.py filter "${folders[@]}") stage tests-of-the-change \
      ctest --preset dev -j "$(nproc)" --no-tests=error -R "^($(cut -d' ' -f2- <<<"$tests" | sed 's/[+.]/\\&/g' | paste -sd'|'))\$"
}

tier_quick() {
  local folders=() chosen=() short=() targets=() everything="" plan kind name budget
  plan=$(scripts/testing/changes.py plan "${base[@]}") || exit 2
  head -1 <<<"$plan"
  while read -r kind name; do
    case $kind in
      folder) folders+=("$name") ;;
      suite) chosen+=("$name") ;;
      page) chosen+=(14-page 15-page-contract) ;;
      everything) everything=yes ;;
    esac
  done <<<"$plan"
  checks
  stage format scripts/lint --fast
  for name in $(printf '%s\n' "${chosen[@]}" | sort -u); do
    budget=$(budget_of "$name")
    if [ "${budget:-0}" -le 60 ]; then short+=("$name"); else echo "-- $(name_of "$name") is left out: it takes $budget s"; fi
  done
  if [ -n "$everything" ]; then
    configure
    stage build cmake --build --preset dev -j "$(nproc)"
    stage unit-and-replay-tests ctest --preset dev -LE "closed_loop|end_to_end|turtlebot" -j2 --no-tests=error
  else
    # Suites that run no program of the build need none.
    for name in "${short[@]}"; do
      case $name in
        10-* | 11-* | 12-* | 14-* | 15-*) ;;
        13-fuzz-replay) targets+=(docent_fuzz_replay) ;;
        *) targets+=(docent docent-lab) ;;
      esac
    done
    if [ ${#folders[@]} -gt 0 ] || [ ${#targets[@]} -gt 0 ]; then build_and_test_folders; fi
  fi
  for name in "${short[@]}"; do stage "$name" "tests/suites/$name"; done
}
