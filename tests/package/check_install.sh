#!/bin/bash
# An integrator's trial by docs/install.md: the commands of its sections, as they stand there, in a small Debian with the package.
#
#   tests/package/check_install.sh PACKAGE.deb [--mirror]
#
# The museum is the integrator's own, published from the editor's interface; the page is asked for over https behind nginx. No systemd
# runs in the root: `systemctl` there does what the unit says, as a user without rights who may write where the unit lets it. Needs root.
set -uo pipefail
. "$(dirname "$0")/small_debian.sh"
deb=$given
is() { diff <(echo "$1") <(echo "$2"); }

make_root "$deb" -- nginx nginx-common openssl curl
cp "$deb" "$root/tmp/docent.deb"
mkdir -p "$root"/usr/local/bin "$root"/tmp "$root"/var/{lib,cache}/private "$root/etc/systemd/system/multi-user.target.wants"
expect "dpkg installs it" inside dpkg -i /tmp/docent.deb
[ $failed -eq 0 ] || finish

# block SECTION [N]: the shell commands of the N-th block of a section of docs/install.md; yaml the same of its yaml.
block() { awk -v section="## $1" -v wanted="${2:-1}" -v kind="${3:-sh}" '
  /^## /{ there = $0 == section } there && $0 == "```" kind { n++; on = n == wanted; next } /^```$/{ on = 0 } there && on' docs/install.md; }

# Stand-ins for what a small Debian in namespaces lacks: sudo, and systemd with its unit.
cat >"$root/usr/local/bin/sudo" <<'END'
#!/bin/sh
exec "$@"
END
cat >"$root/usr/local/bin/systemctl" <<'END'
#!/bin/bash
# start, restart, try-restart, stop of docent by its unit; reload of nginx.
unit=/usr/lib/systemd/system/docent.service
service=61184  # a user that exists while the unit runs, as DynamicUser makes one
case "$*" in
  "stop docent") [ ! -f /run/docent.pid ] || { kill "$(cat /run/docent.pid)"; for i in $(seq 60); do kill -0 "$(cat /run/docent.pid)" 2>/dev/null || break; sleep 0.2; done; rm -f /run/docent.pid; } ;;
  "try-restart docent") [ ! -f /run/docent.pid ] || systemctl restart docent ;;
  "start docent" | "restart docent")
    systemctl stop docent
    for place in lib cache; do
      mkdir -p /var/$place/private
      [ ! -d /var/$place/docent ] || [ -L /var/$place/docent ] || mv /var/$place/docent /var/$place/private/docent
      mkdir -p /var/$place/private/docent
      ln -sfn private/docent /var/$place/docent
    done
    # systemd hands on the whole folder only where its top has another owner.
    [ "$(stat -c %u /var/lib/private/docent)" = $service ] || chown -R $service:$service /var/lib/private/docent
    chown -R $service:$service /var/cache/private/docent
    chmod 755 /var/lib/private /var/cache/private
    while read -r before; do $before || exit 1; done < <(sed -n 's/^ExecStartPre=+//p' $unit)
    . /etc/default/docent
    command=$(sed -n 's/^ExecStart=//p' $unit | sed "s,%S,/var/lib,g; s,%C,/var/cache,g; s,\${MUSEUM},$MUSEUM,; s,\$OPTIONS,$OPTIONS,")
    setpriv --reuid $service --regid $service --clear-groups $command >/tmp/docent.log 2>&1 &
    echo $! >/run/docent.pid ;;
  "reload nginx") if [ -f /run/nginx.pid ]; then nginx -s reload; else nginx; fi ;;
  *) echo "systemctl: $*" >&2; exit 1 ;;
esac
END
chmod +x "$root"/usr/local/bin/{sudo,systemctl}
printf '127.0.0.1 localhost museum.example\n' >"$root/etc/hosts"
sed -i 's/^OPTIONS=.*/OPTIONS="--sim --crowd quiet"/' "$root/etc/default/docent"

# The integrator's own museum: another name, other words.
cp -r museums/bonn "$root/tmp/my-museum"
sed -i 's/^name: .*/name: {en: "My own museum", de: "Mein Museum", fr: "Mon musée"}/' "$root/tmp/my-museum/museum.yaml"
mkdir -p "$root/etc/ssl/private"
quietly inside openssl req -x509 -newkey rsa:2048 -nodes -days 2 -subj /CN=museum.example -addext subjectAltName=DNS:museum.example \
  -keyout /etc/ssl/private/museum.key -out /etc/ssl/certs/museum.pem
cat >"$root/tmp/apt" <<'END'
#!/bin/sh
echo "apt $*: it is there already"
END
install -m 755 "$root/tmp/apt" "$root/usr/local/bin/apt"
block "https" 1 yaml >"$work/https.yaml"
cat "$work/https.yaml" >>"$root/etc/docent/robot.yaml"

{
  echo 'set -eu; cd /tmp; ip link set lo up 2>/dev/null || true'
  echo 'page() { curl -sS --cacert /etc/ssl/certs/museum.pem --cookie-jar /tmp/jar --cookie /tmp/jar "$@"; }'
  echo 'wait_for() { for i in $(seq 120); do curl -s -H "Host: localhost" "http://127.0.0.1:8080$1" 2>/dev/null | grep -q "$2" && return 0; sleep 1; done; echo "no $1"; tail -5 /tmp/docent.log; return 1; }'
  block "Your own museum"
  echo '[ ! -f /run/docent.pid ] || { echo "copying a museum has started the robot"; exit 1; }'
  echo 'systemctl start docent'
  echo 'wait_for /api/museum.json "My own museum"'
  # The commands ask for a password on standard input, without a terminal.
  block "Accounts" | sed 's/#.*//; s/web-account add.*/& <<<"a long pass phrase 4"/'
  block "https"
  cat <<'END'
for i in $(seq 20); do page https://museum.example/ -o /tmp/index.html && break; sleep 1; done
grep -q '<script type="module"' /tmp/index.html || { echo "no page over https"; exit 1; }
page https://museum.example/api/v1/login -o /tmp/nobody.json
page https://museum.example/api/v1/login -H 'Content-Type: application/json' -d '{"name":"ada","password":"a long pass phrase 4"}' -o /tmp/login.json
token=$(sed -n 's/.*"csrf":"\([^"]*\)".*/\1/p' /tmp/login.json)
[ -n "$token" ] || { echo "no login: $(cat /tmp/login.json)"; exit 1; }
grep -q 'TRUE' /tmp/jar || { echo "the cookie is not for https alone"; exit 1; }
# The robot must stand while its museum changes: the stop button, as its keepers remember it over a restart.
systemctl stop docent
mkdir -p /var/lib/docent/stops
for keeper in web robot avoid; do echo "1 stopped ada" >/var/lib/docent/stops/$keeper; done
chown -R --reference=/var/lib/docent/. /var/lib/docent/stops
systemctl start docent
wait_for /api/museum.json "My own museum"
sleep 5
page https://museum.example/api/v1/museum -o /tmp/museum.json
sed -E 's/"is_trial":(true|false),//; s/"home":\[[0-9.]+,/"home":[9.1,/' /tmp/museum.json >/tmp/changed.json
page https://museum.example/api/v1/museum -X PUT -H "Docent-Csrf: $token" -H 'Content-Type: application/json' -d @/tmp/changed.json -o /tmp/put.json
grep -q '^home: .*9\.1' /var/lib/docent/museums/mine/museum.yaml || { echo "not published: $(head -c 300 /tmp/put.json)"; exit 1; }
[ -f /var/lib/docent/museums/mine/museum.yaml.before ] || { echo "what it said before is not kept"; exit 1; }
sleep 10  # all modules read the changed museum, beside a simulated base that shares their two cores
docent doctor --museum /var/lib/docent/museums/mine --robot /etc/docent/robot.yaml --state /var/lib/docent --json >/tmp/doctor.json || { cat /tmp/doctor.json; exit 1; }
systemctl stop docent
nginx -s stop
END
} >"$root/tmp/trial"
said=$(env -i PATH=/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root unshare --net bash -c "ip link set lo up && exec chroot '$root' /bin/bash /tmp/trial" 2>&1)
status=$?
expect "by docs/install.md: own museum, accounts, https, published from the editor, doctor" is 0 "$status"
[ $status -eq 0 ] || { echo "$said"; tail -20 "$root/tmp/docent.log"; }
finish
