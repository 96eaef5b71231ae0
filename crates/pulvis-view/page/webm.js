// Encoded frames as a WebM file: Matroska elements, each an identifier, its length, and what is in it.

const text = (letters) => new TextEncoder().encode(letters);

/** A whole number in so many bytes, the largest first. */
function bytes(value, count) {
  const made = new Uint8Array(count);
  for (let place = count - 1, rest = value; place >= 0; place -= 1, rest = Math.floor(rest / 256)) made[place] = rest % 256;
  return made;
}

/** A length in eight bytes: one, and seven of a number. */
function sized(length) {
  const made = bytes(length, 8);
  made[0] = 0x01;
  return made;
}

const lengthOf = (parts) => parts.reduce((sum, part) => sum + part.length, 0);

/** An element as a list of byte arrays. */
function tag(identifier, ...content) {
  const parts = content.flat();
  const letters = identifier > 0xffffff ? 4 : identifier > 0xffff ? 3 : identifier > 0xff ? 2 : 1;
  return [bytes(identifier, letters), sized(lengthOf(parts)), ...parts];
}

const whole = (identifier, value) => tag(identifier, bytes(value, 8));

function float(identifier, value) {
  const made = new Uint8Array(8);
  new DataView(made.buffer).setFloat64(0, value);
  return tag(identifier, made);
}

/** A frame of the one track: its time after that of the cluster [ms], and whether it needs no other one. */
const block = ({ data, key, time }, start) => tag(0xa3, bytes(0x81, 1), bytes(time - start, 2), bytes(key ? 0x80 : 0, 1), data);

/** Groups of frames, each beginning with one that needs no other one: from there players go on. */
function clusters(frames) {
  const groups = [];
  for (const frame of frames) {
    if (frame.key) groups.push([]);
    groups.at(-1).push(frame);
  }
  return groups.map((group) => ({ time: group[0].time, parts: tag(0x1f43b675, whole(0xe7, group[0].time), ...group.map((frame) => block(frame, group[0].time))) }));
}

/** A file of `frames` (`data`, `key`, `time` [ms], the first one a key frame), `codec` (`V_VP9`, `V_VP8`), size in pixels, and length [ms]. */
export function webm({ frames, codec, width, height, duration }) {
  const head = tag(0x1a45dfa3, whole(0x4286, 1), whole(0x42f7, 1), whole(0x42f2, 4), whole(0x42f3, 8), tag(0x4282, text("webm")), whole(0x4287, 4), whole(0x4285, 2));
  // Times are in milliseconds.
  const info = tag(0x1549a966, whole(0x2ad7b1, 1e6), float(0x4489, duration), tag(0x4d80, text("Pulvis")), tag(0x5741, text("Pulvis")));
  const track = tag(0xae, whole(0xd7, 1), whole(0x73c5, 1), whole(0x83, 1), tag(0x86, text(codec)), tag(0xe0, whole(0xb0, width), whole(0xba, height)));
  const tracks = tag(0x1654ae6b, track);
  const groups = clusters(frames);
  const cues = (from) => {
    let place = from;
    const points = groups.map(({ time, parts }) => {
      const point = tag(0xbb, whole(0xb3, time), tag(0xb7, whole(0xf7, 1), whole(0xf1, place)));
      place += lengthOf(parts);
      return point;
    });
    return tag(0x1c53bb6b, ...points);
  };
  // All numbers have eight bytes, so that the index is as long with its places as without.
  const before = lengthOf(info) + lengthOf(tracks) + lengthOf(cues(0));
  const segment = tag(0x18538067, info, tracks, cues(before), ...groups.map(({ parts }) => parts));
  return new Blob([...head, ...segment], { type: "video/webm" });
}
