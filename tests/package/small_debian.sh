# Sourced first by the checks that install packages in a small Debian, where there is nothing else but what they depend on. Runs
# the script once more in namespaces of its own, at the top of the source tree; needs root. The script's arguments: what to
# install, a file or a folder, and perhaps --mirror.
# Sets: given (the former), mirror, work (a folder of its own), root (the small Debian, see make_root), passed, failed.
given=$(realpath "$1") mirror=${2:-}
if [ "${SMALL_DEBIAN:-}" = "" ]; then
  export SMALL_DEBIAN
  SMALL_DEBIAN=$(mktemp -d /var/tmp/docent-small-debian-XXXXXX)
  # Mounts and processes go with their namespaces.
  unshare --mount --pid --fork --kill-child "$(realpath "$0")" "$given" "${@:2}"
  status=$?
  rm -rf --one-file-system "$SMALL_DEBIAN"
  exit $status
fi
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit 1
work=$SMALL_DEBIAN root=$SMALL_DEBIAN/root passed=0 failed=0

# expect WHAT COMMAND…: counts it; says what it printed when it fails.
expect() {
  local what=$1 said
  shift
  if said=$("$@" 2>&1); then
    echo "ok: $what"
    passed=$((passed + 1))
  else
    printf 'FAILED: %s\n%s\n' "$what" "$said"
    failed=$((failed + 1))
  fi
}
finish() {
  echo "$passed passed, $failed failed"
  [ "$failed" -eq 0 ]
  exit
}
inside() { env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive chroot "$root" "$@"; }
quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }; }

# make_root PACKAGE.deb… [-- NAME…]: the root with what these packages depend on, and with others. It is made of this machine's own
# packages (local_root.sh); with --mirror it is a bare Debian 12 of the machine's Debian mirror, and apt chooses.
make_root() {
  local debs=() deb
  while [ $# -gt 0 ] && [ "$1" != -- ]; do debs+=("$1"); shift; done
  shift
  if [ "$mirror" = --mirror ]; then
    scripts/bare-root "$root" || exit 1
  else
    tests/package/local_root.sh "$root" "${debs[0]}" "$@" || exit 1
  fi
  mount -t proc proc "$root/proc"
  mount --bind /dev "$root/dev"
  if [ "$mirror" = --mirror ]; then
    quietly inside apt-get -qq update
    [ $# -eq 0 ] || quietly inside apt-get -qq -y --no-install-recommends install "$@"
    for deb in "${debs[@]}"; do
      quietly inside apt-get -qq -y --no-install-recommends satisfy "$(dpkg-deb -f "$deb" Depends)"
    done
    inside apt-get clean
  fi
  mount -t tmpfs -o mode=1777 tmp "$root/tmp"
}
