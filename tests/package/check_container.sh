#!/bin/bash
# The image of packaging/Containerfile: what it copies and installs is there; and, where Podman is, it is built upon a bare Debian 12 of the
# machine's mirror and run: program, museum, page.
#
#   tests/package/check_container.sh PACKAGE.deb
#
# Needs root; Podman, Buildah and debootstrap for the second part, which is left out with a word without them. Its images lie in a folder of
# its own.
set -uo pipefail
deb=$(realpath "$1")
cd "$(dirname "$0")/../.." || exit 1
file=packaging/Containerfile
passed=0 failed=0
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

work=$(mktemp -d /var/tmp/docent-container-XXXXXX)
server=
clean() {
  [ -z "$server" ] || kill "$server" 2>/dev/null
  [ -z "$server" ] || wait "$server" 2>/dev/null
  umount "$work/bare/proc" 2>/dev/null  # of a debootstrap that was stopped
  rm -rf --one-file-system "$work"
}
trap clean EXIT
mkdir "$work/context"
cp "$deb" "$work/context/"

# What the file says against what there is.
copied() { (cd "$work/context" && for source in "$@"; do compgen -G "$source" || { echo "no $source beside the package"; return 1; }; done); }
mapfile -t sources < <(sed -n 's/^COPY \(.*\) [^ ]*$/\1/p' "$file" | tr ' ' '\n')
expect "each path of COPY is there (${sources[*]})" copied "${sources[@]}"
listed() { local name; for name in "$@"; do grep -qx -- "$name" scripts/packages.txt || { echo "scripts/packages.txt has no $name"; return 1; }; done; }
mapfile -t names < <(grep -o 'apt-get install .*' "$file" | sed 's/&&.*//' | tr ' ' '\n' | grep -vE '^(apt-get|install|-.*|/.*|)$')
expect "each package that it installs beside Docent is of scripts/packages.txt (${names[*]})" listed "${names[@]}"
packed() { dpkg-deb -c "$deb" | awk '{print $6}' >"$work/files"; local path; for path in "$@"; do grep -qE "^\.$path/?$" "$work/files" || { echo "the package has no $path"; return 1; }; done; }
expect "the museum and the robot.yaml that it names are in the package" packed "$(sed -n 's/^ENV MUSEUM=\([^ ]*\).*/\1/p' "$file")" /etc/docent/robot.yaml
[ $failed -eq 0 ] || finish

for tool in podman buildah debootstrap; do
  command -v $tool >/dev/null && continue
  echo "skipped: the image is not built, there is no $tool"
  finish
done
if [ "$(id -u)" -ne 0 ]; then
  echo "skipped: the image is not built, which needs root"
  finish
fi

# The base is Debian's own, from the mirror of this machine: no registry of images is asked.
store=(--root "$work/store" --runroot "$work/run")
base=$(sed -n 's/^FROM //p' "$file")
scripts/bare-root "$work/bare" || { echo "skipped: the image is not built, debootstrap found no mirror"; finish; }
expect "a bare Debian 12 is the base" bash -c "tar -C '$work/bare' -c . | podman ${store[*]} import - '$base' >/dev/null"
rm -rf --one-file-system "$work/bare"
expect "podman builds the image" podman "${store[@]}" build --pull=never --isolation chroot --network host -f "$file" -t docent "$work/context"
[ $failed -eq 0 ] || finish
# Run by Buildah, which asks for no cgroups.
container=$(buildah "${store[@]}" from --pull-never localhost/docent)
inside() { buildah "${store[@]}" run --isolation chroot --network host "$container" -- "$@"; }
expect "docent --version is the package's" bash -c "diff <(echo 'docent $(dpkg-deb -f "$deb" Version)') -" < <(inside docent --version)
expect "it runs as docent" bash -c 'diff <(echo docent) -' < <(inside id -un)
expect "its museum is fine" inside sh -c 'docent check "$MUSEUM"'
expect "the doctor sees the robot's files" bash -c 'grep -q "fine   museum"' < <(inside docent doctor --robot /etc/docent/robot.yaml --museum /usr/share/docent/museums/bonn --state /var/lib/docent --listen 1 --domain 96)
command=$(sed -n 's/^CMD \["\/bin\/sh", "-c", "\(.*\)"\]$/\1/p' "$file" | sed 's/\\"/"/g')
port=18196
inside env OPTIONS="--sim --crowd empty --domain 96 --port $port" /bin/sh -c "$command" >"$work/up.log" 2>&1 &
server=$!
answers() { for _ in $(seq 120); do curl -sf "http://127.0.0.1:$port/" >"$work/page" && return 0; kill -0 $server 2>/dev/null || break; sleep 0.5; done; tail -20 "$work/up.log"; return 1; }
expect "what it starts serves the page" answers
expect "which is Docent's" grep -qi "docent" "$work/page"
finish
