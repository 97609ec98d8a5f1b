#!/bin/bash
# Makes the root of a small Debian of this machine's own packages, without a network: local_root.sh DIR PACKAGE.deb [NAME…].
# DIR gets the essential packages, what the package and those of these names depend on, and the latter: their files and what
# dpkg knows of them. Nothing else of this machine is in it, and not the package itself.
set -euo pipefail
root=$1 deb=$(realpath "$2")
shift 2
installed() { dpkg-query -W -f '${db:Status-Status} ${Essential} ${binary:Package}\n' | awk "\$1 == \"installed\" $1 {print \$3}"; }
mapfile -t essential < <(installed '&& $2 == "yes"')
# Only what dpkg knows to be here and the file itself: no list of any archive.
mapfile -t packages < <(
  apt-cache -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts=/dev/null --with-source="$deb" depends --recurse \
    --no-recommends --no-suggests --no-conflicts --no-breaks --no-replaces --no-enhances \
    "${essential[@]}" "$@" "$(dpkg-deb -f "$deb" Package)" |
    grep -E '^[a-z0-9]' | sed 's/:.*//' | sort -u | comm -12 - <(installed '' | sed 's/:.*//' | sort -u))

mkdir -p "$root"/{usr/{bin,sbin,lib,lib64},dev,proc,sys,run,root,tmp,var/tmp,var/log,var/lib/dpkg/{info,updates,triggers}}
for link in bin sbin lib lib64; do ln -s "usr/$link" "$root/$link"; done
chmod 1777 "$root/tmp" "$root/var/tmp"
# A machine may have been told to leave manuals and translations out; tar passes over what is not there.
dpkg-query -L "${packages[@]}" | grep '^/' | sort -u | sed 's,^/,,; /^\.\?$/d' |
  tar -C / --no-recursion --ignore-failed-read -cf - -T - 2>/dev/null | tar -C "$root" --skip-old-files -xpf -
cp -a /etc/passwd /etc/group /etc/nsswitch.conf /etc/alternatives "$root/etc/"
# Links that update-alternatives has made belong to no package.
find /usr/bin /usr/lib -lname '/etc/alternatives/*' | while read -r link; do
  if [ -e "$root$(readlink -f "$link")" ] && [ ! -e "$root$link" ]; then cp -a "$link" "$root$link"; fi
done
ldconfig -r "$root"

cd "$root/var/lib/dpkg"
for package in "${packages[@]}"; do
  dpkg-query -s "$package"
  echo
  cp /var/lib/dpkg/info/"$package"{,:*}.* info/ 2>/dev/null || true
done >status
cp /var/lib/dpkg/info/format info/
cp status status-old
touch available diversions statoverride
