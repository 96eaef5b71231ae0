// Where the page has its numbers from: the server that serves it, or what is embedded in it.

async function asked(path, options) {
  const response = await fetch(path, options);
  if (response.ok) return response;
  let why = `${response.status} ${response.statusText}`;
  try {
    why = (await response.json()).error ?? why;
  } catch {
    // Not from our server.
  }
  throw new Error(why);
}

const json = async (path, options) => (await asked(path, options)).json();
const send = (path, body) => json(path, { method: "POST", body });

/** Letters, length, header, floats. */
function unpack(buffer, letters) {
  const view = new DataView(buffer);
  const found = String.fromCharCode(...new Uint8Array(buffer, 0, 4));
  if (found !== letters) throw new Error(`the server sent ${found} in place of ${letters}`);
  const length = view.getUint32(4, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 8, length)));
  return { header, numbers: new Float32Array(buffer, 8 + length) };
}

/** Parts of one array, of these lengths. */
function parts(numbers, lengths) {
  let start = 0;
  return lengths.map((length) => numbers.subarray(start, (start += length)));
}

export class Server {
  /** A run that may grow. */
  live = true;

  laws = () => json("api/laws");
  presets = () => json("api/presets");
  start = (role, law) => json(`api/start?role=${encodeURIComponent(role)}&law=${encodeURIComponent(law)}`);
  read = (text) => send("api/state", text);
  collide = (text, velocity, quick) => send(`api/collide?velocity=${velocity}${quick ? "&quick=1" : ""}`, text);
  oblique = (text, degrees, quick) => send(`api/oblique?angle=${(degrees * Math.PI) / 180}${quick ? "&quick=1" : ""}`, text);
  sticking = (text) => send("api/sticking", text);
  map = (text, { parameter, values, stride = 1, row_stride = 1, known = 0 }) => send(`api/map?parameter=${encodeURIComponent(parameter)}&values=${values.join(",")}&stride=${stride}&row_stride=${row_stride}&known=${known}`, text);
  probe = (text) => send("api/probe", text);
  run = () => json("api/run");
  particle = (number, row) => json(`api/particle?number=${number}&row=${row}`);

  async frame(number, column) {
    const wanted = column ? `&column=${encodeURIComponent(column)}` : "";
    const response = await asked(`api/frame?number=${number}${wanted}`);
    const { header, numbers } = unpack(await response.arrayBuffer(), "PVP1");
    const { particles, walls: lines } = header;
    const [positions, radii, values, walls, wallRadii, triangles] = parts(numbers, [3 * particles, particles, particles, 6 * lines, lines, 9 * header.triangles]);
    return { ...header, positions, radii, values, walls, wallRadii, triangles };
  }

  async contacts(number) {
    const response = await asked(`api/contacts?number=${number}`);
    const { header, numbers } = unpack(await response.arrayBuffer(), "PVC1");
    const [ends, forces] = parts(numbers, [6 * header.contacts, header.contacts]);
    return { ends, forces };
  }

  series(columns) {
    return json(`api/series?columns=${columns.map(encodeURIComponent).join(",")}`);
  }
}

function floats(text) {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let place = 0; place < letters.length; place += 1) bytes[place] = letters.charCodeAt(place);
  return new Float32Array(bytes.buffer);
}

/** A run in the page itself. */
export class Embedded {
  live = false;

  constructor(data) {
    this.data = data;
    this.decoded = new Map();
  }

  run = async () => this.data.run;
  series = async () => this.data.series ?? { names: [], rows: 0, columns: {} };

  column(number, name) {
    const frame = this.data.frames[number];
    const place = frame.names.findIndex((one) => one.name === name);
    return place < 0 ? null : floats(frame.columns[place]);
  }

  async frame(number, column) {
    const frame = this.data.frames[number];
    const values = (column && this.column(number, column)) || new Float32Array(frame.particles);
    return {
      time: frame.time,
      particles: frame.particles,
      columns: frame.names,
      contacts: floats(frame.forces).length,
      positions: floats(frame.positions),
      radii: this.column(number, "radius"),
      values,
      walls: floats(frame.walls),
      wallRadii: floats(frame.wall_radii),
      triangles: floats(this.data.surfaces[frame.surface]),
    };
  }

  async contacts(number) {
    const frame = this.data.frames[number];
    return { ends: floats(frame.contacts), forces: floats(frame.forces) };
  }

  async particle(number, row) {
    const frame = this.data.frames[number];
    const positions = floats(frame.positions);
    const columns = frame.names.map(({ name }) => ({ name, value: this.column(number, name)[row] }));
    const id = columns.find((one) => one.name === "id")?.value ?? null;
    return { row, id, position: [...positions.subarray(3 * row, 3 * row + 3)], columns, contacts: id === null ? [] : this.contactsOf(number, id) };
  }

  /** As the server tells them: the other's id and row, or the number of the wall. */
  contactsOf(number, id) {
    const { bodies: [first, second], forces, overlaps } = this.data.frames[number];
    const [ids, force, overlap] = [this.column(number, "id"), floats(forces), floats(overlaps)];
    const own = first.map((one, place) => place).filter((place) => first[place] === id || second[place] === id);
    return own.map((place) => {
      const other = first[place] === id ? second[place] : first[place];
      const row = ids.indexOf(other);
      const columns = [{ name: "normal_force", value: force[place] }, { name: "overlap", value: overlap[place] }];
      return { id: other >= 0 ? other : null, row: row >= 0 ? row : null, wall: other < 0 ? -1 - other : null, columns };
    });
  }
}
