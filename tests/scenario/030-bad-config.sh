#!/bin/bash
# mfard must refuse an invalid configuration and print the position of every fault. It must not open
# any device or other file.
. "$(dirname "$0")/lib.sh"

cat >mfard.toml <<'END'
display = "png:shown"
sed = 3
[trigger]
mode = "sometimes"
max_age_s = -1
END
for check in "" --check-config; do
    run 78 --config mfard.toml $check
    says err 'mfard.toml:2:1: unknown key sed; the nearest known one is seed$'
    says err 'mfard.toml:4:8: trigger.mode = "sometimes": .*"demand"'
    says err 'mfard.toml:5:13: trigger.max_age_s must be from'
    [ "$(wc -l <err)" = 3 ] || fail "mfard did not write exactly three messages"
done
[ ! -e shown ] || fail "mfard opened the display although the configuration is invalid"

echo 'seed = ' >mfard.toml
run 78 --config mfard.toml
says err 'mfard.toml:1:'

echo "a quote that is not closed is named as such"
printf 'seed = 3\nsource = "synthetic:office\n[trigger]\n' >mfard.toml
run 78 --config mfard.toml --check-config
says err 'mfard.toml:2:27: the closing quote of a text is missing'
printf '[trigger]\nmode = """demand' >mfard.toml
run 78 --config mfard.toml --check-config
says err 'mfard.toml:2:17: the closing quote of a text is missing$'

echo 'seed = 3' >mfard.toml
run 0 --config mfard.toml --check-config
says out '^ok$'
for option in --check-config --print-config --version; do
    code=0
    "$mfard" --config mfard.toml "$option" >/dev/full 2>err || code=$?
    [ "$code" = 74 ] || fail "mfard $option ended with exit code $code although its output could not be written"
    says err 'mfard: standard output cannot be written'
done

run 66 --config missing.toml
says err 'missing.toml: cannot be read'
run 64 --recording
run 64 --source camera
says err 'synthetic'
