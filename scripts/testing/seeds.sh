# Sourced: the files of the project itself that serve a fuzzer as seeds, beside its folder in tests/corpus.

# files_for FUZZER: one a line.
files_for() {
  case $1 in
    museum_museum_reader) ls museums/*/museum.yaml ;;
    simulator_world_world) ls museums/*/simulation.yaml ;;
  esac
}
