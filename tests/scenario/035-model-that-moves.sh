#!/bin/bash
# mfard shows models at rest. If a model's file contains animations, mfard must say so once, also
# when it only checks the configuration.
. "$(dirname "$0")/lib.sh"

cat >thing.gltf <<'END'
{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri":
     "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"}],
 "animations": [{"channels": [], "samplers": []}]}
END
for id in 0 1; do printf '[[objects]]\nmodel = "thing.gltf"\ntag = %d\n' "$id"; done >mfard.toml
said='warning: .*thing.gltf: animations\[0\]: animations are not played; the model is shown at rest$'

run 0 --config mfard.toml --check-config
says out '^ok$'
says err "$said"
[ "$(wc -l <err)" = 1 ] || fail "mfard did not write exactly one message"

run 0 --source synthetic:office,rest --display none --frames 20 --config mfard.toml
says err "$said"
[ "$(grep -c "not played" err)" = 1 ] || fail "mfard did not warn exactly once"

sed -i '/animations/d; s/AAAAAA"}],$/AAAAAA"}]}/' thing.gltf
run 0 --config mfard.toml --check-config
[ ! -s err ] || fail "mfard warns about a model without animations"
