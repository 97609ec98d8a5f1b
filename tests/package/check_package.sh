#!/bin/bash
# Installs the Debian package where there is nothing else but what it depends on, lets the robot run there, and purges it.
#
#   tests/package/check_package.sh PACKAGE.deb [--mirror]
#
# small_debian.sh says what the root is made of. Needs root: all runs in namespaces of its own.
set -uo pipefail
. "$(dirname "$0")/small_debian.sh"
deb=$given
is() { diff <(echo "$1") <(echo "$2"); }

python=$(echo "$(dirname "$deb")"/python3-docent_*.deb)
tools=()
[ -f "$python" ] && tools=(python3 python3-numpy python3-pytest)
make_root "$deb" -- "${tools[@]}"  # what the program writes in /tmp is no part of the comparison
cp "$deb" "$root/tmp/docent.deb"
mkdir -p "$root"/var/{lib,cache}/private "$root/etc/systemd/system/multi-user.target.wants"  # every systemd has them
# Names, kinds and modes of all files but those of the mounts and dpkg's own locks, triggers and log.
files() { find "$root" -xdev -printf '%P %y %m %l\n' | grep -vE '^var/(lib/dpkg/(lock|triggers/)|log/dpkg.log)' | sort; }
files >"$work/before"

expect "dpkg installs it with its dependencies and nothing else" inside dpkg -i /tmp/docent.deb
[ $failed -eq 0 ] || finish
expect "the source tree is not visible" bash -c "! [ -e '$root$PWD' ]"
expect "docent --version is the package's version" is "docent $(dpkg-deb -f "$deb" Version)" "$(inside docent --version)"
expect "the laboratory is not in it" bash -c "! [ -e '$root/usr/bin/docent-lab' ]"
for museum in bonn smithsonian; do
  expect "docent check says that $museum is fine" inside docent check /usr/share/docent/museums/$museum
  expect "docent golog check says that its tour program is fine" inside docent golog check /usr/share/docent/museums/$museum
done
expect "/etc/docent/robot.yaml changes no default" \
  diff "$root/usr/share/docent/docs/robot.yaml" <(inside docent config --robot /etc/docent/robot.yaml)
sed -n '/^#body:/,$ s/^#//p' "$root/etc/docent/robot.yaml" >"$root/tmp/uncommented.yaml"
expect "and names all of them" \
  diff "$root/usr/share/docent/docs/robot.yaml" <(inside docent config --robot /tmp/uncommented.yaml)
expect "its last line, too" diff <(tail -1 "$root/tmp/uncommented.yaml") <(tail -1 "$root/usr/share/docent/docs/robot.yaml")
mkdir -p "$root/tmp/moved/share" && cp -r "$root/usr/bin" "$root/tmp/moved/" && cp -r "$root/usr/share/docent" "$root/tmp/moved/share/"
expect "a moved prefix finds its own museum" grep -qE -- '--museum .*/tmp/moved/share/docent/museums/bonn' <(inside /tmp/moved/bin/docent up --help)
expect "and its own tour program" grep -qF "/tmp/moved/share/docent/prolog/tour_guide.pl: fine" \
  <(inside /tmp/moved/bin/docent golog check /usr/share/docent/museums/bonn)
if [ -f "$python" ]; then
  dpkg-deb -x "$python" "$root/tmp/python" && cp python/tests/test_simulation.py "$root/tmp/"
  expect "the Python package runs it" inside bash -c "cd /usr/share/docent && PYTHONPATH=/tmp/python/usr/lib/python3/dist-packages \
    PYTHONDONTWRITEBYTECODE=1 XDG_CACHE_HOME=/tmp/cache exec python3 -m pytest -q -p no:cacheprovider /tmp/test_simulation.py"
fi
expect "docent ros check names the installed file for ROS 2's side" \
  grep -q "CYCLONEDDS_URI=file:///usr/share/docent/dds/loopback.xml" <(inside docent ros check --seconds 0.5 --domain 199)
expect "and both files are there" bash -c "[ -s '$root/usr/share/docent/dds/loopback.xml' ] && [ -s '$root/usr/share/docent/dds/fastdds.xml' ]"
expect "docent_msgs for ROS 2 holds what the IDL holds" tests/package/check_messages.py "$root/usr/share/docent"
unit=$root/usr/lib/systemd/system/docent.service
if command -v systemd-analyze >/dev/null; then
  sed "s,^ExecStart=/usr/bin/docent,ExecStart=/bin/true," "$unit" >"$work/docent.service"
  expect "systemd finds no fault in the unit" is "" "$(systemd-analyze verify --man=no "$work/docent.service" 2>&1)"
else
  echo "skipped: the unit, no systemd-analyze here"
fi

# The unit's own command with --sim, as a user without rights, in a network of its own.
. "$root/etc/default/docent"
command=$(sed -n 's/^ExecStart=//p' "$unit" | sed "s,%[SC]/docent,/tmp/state,g; s,\${MUSEUM},$MUSEUM,; s,\$OPTIONS,--sim,")
cat >"$root/tmp/run" <<END
get() { exec 3<>/dev/tcp/127.0.0.1/8080 && printf "GET \$1 HTTP/1.0\r\n\r\n" >&3 && cat <&3; }
wait_for() { for _ in \$(seq 60); do get "\$1" 2>/dev/null | tr -d '\0' | grep -q "\$2" && return 0; sleep 1; done; return 1; }
$command >/tmp/log 2>&1 &
wait_for / '<script type="module"' || echo "no page"
get / | sed '1,/^\r\$/d' | cmp - /usr/share/docent/web/dist/index.html
wait_for /api/museum.json '"id"' || echo "no museum"
wait_for /api/health '"name":"localize"[^}]*"state":"ready"' || echo "not localized"
kill %1; wait %1 || echo "ended with \$?"
END
mkdir -m 777 "$root/tmp/state"
said=$(env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/nonexistent unshare --net bash -c \
  "ip link set lo up && exec chroot --userspec=nobody:nogroup '$root' /bin/bash /tmp/run" 2>&1)
expect "the unit's command: the page answers, the robot finds itself, all ends in order" is "" "$said"
[ -z "$said" ] || cat "$root/tmp/log"

# What the unit writes as a dynamic user, and an administrator.
mkdir "$root"/var/{lib,cache}/private/docent
for place in lib cache; do ln -s private/docent "$root/var/$place/docent" && touch "$root/var/$place/docent/mission.sqlite"; done
ln -s /usr/lib/systemd/system/docent.service "$root/etc/systemd/system/multi-user.target.wants/"
echo 'body: {max_speed: 0.5}' >>"$root/etc/docent/robot.yaml"
expect "removing keeps what an administrator changed" bash -c "chroot '$root' dpkg -r docent && grep -q max_speed '$root/etc/docent/robot.yaml'"
expect "dpkg purges it" inside dpkg --purge docent
files >"$work/after"
expect "nothing of it is left" diff "$work/before" "$work/after"
finish
