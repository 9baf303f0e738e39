// The controls, the sentence, the numbers, the pictures and the texts. All numbers come from granulaw.explore().
(() => {
  const byId = (id) => document.getElementById(id);

  // Rows: sign, name, unit, range of the slider. `zero`: the slider's left end is 0; `never`: its right end is infinity.
  const KINDS = {
    youngs_modulus: {sign: "E", name: "Young's modulus", unit: "Pa", low: 1e6, high: 1e12},
    poisson_ratio: {sign: "ν", name: "Poisson's ratio", unit: "", low: 0, high: 0.49, linear: true},
    yield_stress: {sign: "Y", name: "yield stress", unit: "Pa", low: 1e4, high: 1e10, never: true},
    hardening_modulus: {sign: "H", name: "hardening dσ/dε", unit: "Pa", low: 1e4, high: 1e11, zero: true},
    density: {sign: "ρ", name: "density", unit: "kg/m³", low: 50, high: 20000},
    radius: {sign: "R", name: "radius", unit: "m", low: 1e-6, high: 0.1},
    speed: {sign: "V", name: "approach speed", unit: "m/s", low: 1e-4, high: 100},
    fall: {sign: "h", name: "height of fall", unit: "m", low: 1e-8, high: 500},
    bed: {sign: "B", name: "height of the bed", unit: "m", low: 1e-3, high: 100},
    scatter: {sign: "s", name: "sd of e where none is stated", unit: "%", low: 0.1, high: 20},
  };
  const GRAVITY = 9.81;
  const OF_MATERIAL = ["youngs_modulus", "poisson_ratio", "yield_stress", "hardening_modulus", "density"];
  const PARTNERS = {wall: "rigid wall", like: "its like", sphere: "another sphere", thick: "deformable wall"};
  const FACTORS = {p: 1e-12, n: 1e-9, u: 1e-6, "µ": 1e-6, "μ": 1e-6, m: 1e-3, c: 1e-2, k: 1e3, M: 1e6, G: 1e9, T: 1e12};

  // A number as people write it: "91e6", "91 MPa", "2,5 GPa", "3 mm", "0.92 g/cm3", "never". NaN where it is none.
  function number_in(text, kind) {
    const words = text.trim().replace(/(\d),(\d)/g, "$1.$2");
    if (kind.never && /^(never|none|elastic|inf(inity)?|)$/i.test(words)) return Infinity;
    const found = /^([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*(.*)$/i.exec(words);
    if (!found) return NaN;
    const value = Number(found[1]), unit = found[2].replace(/\^|\*\*/g, "").replace("³", "3").trim();
    const base = kind.unit.replace("³", "3");
    if (unit === "" || unit === base) return value;
    if (base === "%") return NaN;
    if (base === "kg/m3") return unit === "g/cm3" || unit === "t/m3" ? 1000 * value : NaN;
    if (base === "" || !unit.endsWith(base)) return NaN;
    return value * (FACTORS[unit.slice(0, -base.length)] ?? NaN);
  }
  const text_of = (value, kind) => !Number.isFinite(value) ? "never" : kind.unit === "" ? `${Number(value.toPrecision(5))}`
    : kind.unit === "kg/m³" || kind.unit === "%" ? `${Number(value.toPrecision(5))} ${kind.unit}` : with_unit(value, kind.unit, 5);

  const copy_of = (name) => ({...(MATERIALS.find((m) => m.name === name) ?? MATERIALS[0])});
  let state = {first: copy_of("wax"), second: copy_of("steel-elastic"), partner: "wall", radius: 3e-3, radius2: 3e-3, speed: 1, bed: 0.1};
  const drops = {scatter: 1, fit: null};
  let kept = null, now = null, then = null, shown = "materials.toml", pending = false, problem = null;

  function request_of(s) {
    const numbers = ({name, density, youngs_modulus, poisson_ratio, yield_stress, hardening_modulus}) =>
      ({name, density, youngs_modulus, poisson_ratio, yield_stress, hardening_modulus});
    const partner = {wall: "wall", like: "like", sphere: {material: numbers(s.second), radius: s.radius2}, thick: {material: numbers(s.second), radius: Infinity}}[s.partner];
    if (typeof partner === "object" && s.second.name === s.first.name && OF_MATERIAL.every((key) => s.second[key] === s.first[key])) delete partner.material;
    return {material: numbers(s.first), radius: s.radius, partner, speed: s.speed};
  }

  // --- the address: one state, or two with "~" between
  const KEYS = {youngs_modulus: "E", poisson_ratio: "nu", yield_stress: "Y", hardening_modulus: "H", density: "rho"};
  function written(s) {
    const part = new URLSearchParams({name: s.first.name});
    const put = (material, tail) => OF_MATERIAL.forEach((key) => part.set(KEYS[key] + tail, `${material[key]}`));
    put(s.first, "");
    part.set("R", s.radius), part.set("with", s.partner), part.set("V", s.speed), part.set("B", s.bed);
    if (s.partner === "sphere" || s.partner === "thick") part.set("name2", s.second.name), put(s.second, "2"), part.set("R2", s.radius2);
    return part.toString();
  }
  function read(text) {
    const part = new URLSearchParams(text), s = {...state, first: {...state.first}, second: {...state.second}};
    const take = (object, key, name, kind) => {
      if (!part.has(name)) return;
      const value = part.get(name) === "Infinity" && kind.never ? Infinity : Number(part.get(name) || NaN);
      if (!Number.isNaN(value) && value >= 0) object[key] = value;
      else damaged.push(name);
    };
    const damaged = [];
    for (const [material, tail] of [[s.first, ""], [s.second, "2"]]) {
      if (part.has("name" + tail)) material.name = safe_name(part.get("name" + tail)), material.source = "from a link";
      OF_MATERIAL.forEach((key) => take(material, key, KEYS[key] + tail, KINDS[key]));
    }
    take(s, "radius", "R", KINDS.radius), take(s, "radius2", "R2", KINDS.radius), take(s, "speed", "V", KINDS.speed), take(s, "bed", "B", KINDS.bed);
    if (part.has("with")) part.get("with") in PARTNERS ? s.partner = part.get("with") : damaged.push("with");
    problem = damaged.length ? `The link is damaged: ${damaged.join(", ")} cannot be read, and other values stand in.` : null;
    return s;
  }
  const safe_name = (text) => text.replace(/[^A-Za-z0-9_-]/g, "").slice(0, 40).replace(/^wall$/, "") || "material";
  function from_address() {
    const [first, second] = location.hash.slice(1).split("~");
    if (first) state = read(first);
    if (second) { const said = problem; kept = read(second); problem = said ?? problem; }
  }
  function to_address() { history.replaceState(null, "", "#" + written(state) + (kept ? "~" + written(kept) : "")); }

  // --- controls
  const controls = [];
  function add_row(parent, key, object, tail = "") {
    const kind = KINDS[key], id = key + tail, row = document.createElement("div");
    row.className = "row";
    row.innerHTML = `<label for="${id}"><i>${kind.sign}</i>${kind.name}</label><input type="text" id="${id}" inputmode="text" spellcheck="false">` +
      `<input type="range" id="${id}-slider" min="0" max="1000" aria-label="${kind.name}, slider">`;
    parent.append(row);
    const [field, slider] = row.querySelectorAll("input"), field_key = key === "radius" ? key + tail : key;
    const share = (value) => kind.linear ? (value - kind.low) / (kind.high - kind.low) : Math.log(value / kind.low) / Math.log(kind.high / kind.low);
    const changed = (value) => {
      object()[field_key] = value;
      if (OF_MATERIAL.includes(key)) object().source = "changed by hand";
      problem = null;
      update();
    };
    field.addEventListener("change", () => {
      const value = number_in(field.value, kind), good = !Number.isNaN(value);
      field.setAttribute("aria-invalid", `${!good}`);
      if (good) changed(value);
    });
    slider.addEventListener("input", () => {
      const at = slider.value / 1000;
      let value = kind.linear ? kind.low + at * (kind.high - kind.low) : kind.low * (kind.high / kind.low) ** at;
      if (kind.zero && at === 0) value = 0;
      changed(kind.never && at === 1 ? Infinity : Number(value.toPrecision(3)));
    });
    controls.push(() => {
      const value = object()[field_key];
      if (document.activeElement !== field || field.getAttribute("aria-invalid") !== "true") {
        field.value = text_of(value, kind);
        field.setAttribute("aria-invalid", "false");
      }
      if (document.activeElement !== slider) slider.value = value === Infinity ? 1000 : Math.round(1000 * Math.min(1, Math.max(0, value > 0 || kind.linear ? share(value) : 0)));
      slider.setAttribute("aria-valuetext", text_of(value, kind));
    });
  }
  function add_presets(id, which) {
    const list = byId(id);
    MATERIALS.forEach((m) => list.append(new Option(m.name, m.name)));
    list.append(new Option("your own", ""));
    list.addEventListener("change", () => { if (list.value) state[which] = copy_of(list.value); update(); });
    controls.push(() => {
      const of_list = MATERIALS.find((m) => m.name === state[which].name && OF_MATERIAL.every((key) => m[key] === state[which][key]));
      list.value = of_list?.name ?? "";
      byId(id.replace("preset", "source")).textContent = of_list?.source ?? state[which].source;
    });
  }
  function add_partners() {
    for (const [value, name] of Object.entries(PARTNERS)) {
      const label = document.createElement("label");
      label.innerHTML = `<input type="radio" name="with" value="${value}">${name}`;
      byId("partners").append(label);
      label.firstChild.addEventListener("change", () => { state.partner = value; update(); });
      controls.push(() => { label.firstChild.checked = state.partner === value; });
    }
    controls.push(() => {
      byId("partner").hidden = state.partner === "wall" || state.partner === "like";
      byId("radius2").closest(".row").hidden = state.partner === "thick";
    });
  }

  // The speed as the height of fall that gives it.
  const falling = {get fall() { return state.speed ** 2 / 2 / GRAVITY; }, set fall(height) { state.speed = Number(Math.sqrt(2 * GRAVITY * height).toPrecision(6)); }};

  // --- drop tests
  // Rows of two or three numbers become the CSV of mpm calibrate; a text with a header is one already.
  function drops_csv() {
    const text = byId("drops").value, rows = text.split(/\r?\n/).map((row) => row.trim()).filter((row) => row && !row.startsWith("#"));
    if (!rows.length || /[^\d\s.,;eE+-]/.test(rows[0])) return rows.length ? text : "";
    const numbers = rows.map((row) => {
      const spaced = row.replace(/,\s+/g, " ");
      return (/[;\s]/.test(spaced) ? spaced.replace(/,/g, ".").split(/[;\s]+/) : spaced.split(",")).join(",");
    });
    return `velocity_m_per_s,restitution${numbers[0].split(",").length === 3 ? ",restitution_sd" : ""}\n${numbers.join("\n")}\n`;
  }
  function fit_drops() {
    const data = drops_csv(), {material, radius, partner} = request_of(state);
    drops.fit = data ? granulaw.calibrate_now({data, relative_sd: drops.scatter / 100, material, radius, partner}) : null;
    const fit = drops.fit, yield_stress = fit && !fit.problem ? fit.parameters.yield_stress : null;
    byId("take").disabled = !yield_stress || fit.bound !== "" || !fit.followed;
    byId("fitted").textContent = !fit ? "" : fit.problem ? `${fit.problem}.`
      : `${fit.verdict} E, ν, H and ρ above are taken as known. To fit several numbers, or other measurements, use mpm calibrate: the tab drops.csv has the command.`;
  }
  function drops_command() {
    const {first, second, partner, radius} = state;
    const words = ["mpm calibrate drops.csv", `--radius ${radius}`, `--density ${first.density}`, `--poisson-ratio ${first.poisson_ratio}`, `--youngs-modulus ${first.youngs_modulus}`,
      ...(first.hardening_modulus > 0 ? [`--hardening-modulus ${first.hardening_modulus}`] : []), "--fit yield_stress", ...(drops.scatter === 1 ? [] : [`--relative-sd ${Number((drops.scatter / 100).toPrecision(6))}`]),
      ...(partner === "like" ? ["--partner equal"] : partner === "thick" ? [`--wall ${own_name()} --materials-file materials.toml`] : [])];
    return partner === "sphere" ? "# two spheres that differ are not fitted" : `# ${words.join(" ")}`;
  }
  function add_drops() {
    byId("drops").addEventListener("input", () => update());
    byId("drops-file").addEventListener("change", async (event) => { const file = event.target.files[0]; if (file) byId("drops").value = await file.text(), update(); });
    byId("take").addEventListener("click", () => {
      state.first.yield_stress = Number(drops.fit.parameters.yield_stress.value.toPrecision(4));
      state.first.source = "Y from your drop tests";
      update();
    });
  }

  // --- what is said
  const percent = (part) => `${Number((100 * part).toPrecision(2))} %`;
  const change = (value, before) => `${value >= before ? "+" : "−"}${percent(Math.abs(value / before - 1))}`;
  const words_of = (s) => `${s.first.name}, R ${with_unit(s.radius, "m", 3)}, ${s.partner === "wall" ? "on a rigid wall" : s.partner === "like" ? "on its like"
    : s.partner === "thick" ? `on a deformable wall of ${s.second.name}` : `on ${s.second.name} of R ${with_unit(s.radius2, "m", 3)}`}, ${with_unit(s.speed, "m/s", 3)}`;

  // [class, sentence]: green, amber with the reason, red with the reason.
  function verdict(s, a) {
    if (a.problem) return ["bad", `No law: ${a.problem}.`];
    const {law, limits} = a, reasons = [...a.warnings.map((w) => w + ".")];
    const depth = law.delta_max_m / a.length;
    if (depth > 0.1) reasons.push(`The overlap is ${Number(depth.toPrecision(2))} ${length_name()}: beyond 0.1 ${length_name()} the support of the bodies changes the force.`);
    const outcome = !(limits.yield_speed !== null && s.speed > limits.yield_speed)
      ? `nothing yields${limits.yield_speed === null ? "" : ` below ${with_unit(limits.yield_speed, "m/s", 3)}`}: Hertz suffices.`
      : `rebounds at ${with_unit(law.e * s.speed, "m/s", 3)}, ${Number((s.speed / limits.yield_speed).toPrecision(2))} times the speed of first yield. Hertz's force would be ${with_unit(a.hertz.force_max_N, "N", 3)} (${change(a.hertz.force_max_N, law.force_max_N)}), Thornton's e ${a.thornton.e.toFixed(3)}.`;
    const bound = law.error_force === null ? "" : ` Error of this ${law.law_kind} law: F within ${percent(law.error_force)}, e within ${Number(law.error_restitution.toPrecision(2))}.`;
    return [reasons.length ? "fair" : "good", outcome + bound + (reasons.length ? " " + reasons.join(" ") : "")];
  }
  function say(s, a) {
    const [kind, text] = verdict(s, a), sentence = byId("sentence"), name = document.createElement("strong");
    name.textContent = words_of(s) + ": ";
    sentence.replaceChildren(name, text, problem ? " " + problem : "");
    byId("verdict").className = problem && kind === "good" ? "fair" : kind;
  }
  function number_rows(a) {
    const {law, limits} = a, within = (error, unit) => error === null ? "no bound stated" : `± ${unit(error)} (95 %)`;
    return [
      ["restitution e", law.e, law.e.toFixed(4), within(law.error_restitution, (x) => Number(x.toPrecision(2)))],
      ["largest force", law.force_max_N, with_unit(law.force_max_N, "N"), within(law.error_force, percent)],
      ["largest overlap", law.delta_max_m, with_unit(law.delta_max_m, "m"), `${Number((law.delta_max_m / a.length).toPrecision(2))} ${length_name()}, limit 0.1`],
      ["residual overlap", law.delta_residual_m, with_unit(law.delta_residual_m, "m"), `${percent(law.delta_residual_m / law.delta_max_m)} of the largest`],
      ["contact time", law.contact_time_s, with_unit(law.contact_time_s, "s"), `Hertz: ${with_unit(a.hertz.contact_time_s, "s", 3)}`],
      ["largest time step", limits.largest_time_step, with_unit(limits.largest_time_step, "s"), `${Math.floor(law.contact_time_s / limits.largest_time_step)} steps in this contact`],
      ["yields from", limits.yield_speed ?? Infinity, with_unit(limits.yield_speed ?? Infinity, "m/s", 3), `law ends at ${with_unit(limits.end_speed ?? Infinity, "m/s", 3)}`],
    ];
  }
  function show_numbers() {
    const before = then && !then.problem ? number_rows(then) : null;
    byId("numbers").replaceChildren(...(now.problem ? [] : number_rows(now)).map(([name, value, text, note], k) => {
      const box = document.createElement("div");
      const add = (tag, content, kind = "") => { const part = document.createElement(tag); part.textContent = content; part.className = kind; box.append(part); };
      add("span", name), add("b", text), add("span", note);
      if (before) add("span", `kept: ${before[k][2]}${Number.isFinite(value) && Number.isFinite(before[k][1]) && before[k][1] > 0 ? ` (now ${change(value, before[k][1])})` : ""}`, "kept");
      return box;
    }));
  }

  // What mpm plan and mpm stretch say of a bed of these bodies: rows of [name, text, class].
  function bed_rows(b) {
    const yielding = b.pairs.filter((pair) => pair.needs_table), deepest = top_of(b.pairs.map((pair) => pair.depth)), {soften} = b;
    return [
      ["plastic law", yielding.length ? `needed: ${yielding.map((pair) => pair.materials.join(":")).join(", ")}`
        : "not needed: nothing yields at this speed, Hertz suffices", yielding.length ? "fair" : "good"],
      ["Hertz instead", now.problem ? "no law" : `the contact shown would have e = 1 in place of ${now.law.e.toFixed(3)}, and a force changed by ${change(now.hertz.force_max_N, now.law.force_max_N)}`, ""],
      ["neighbours", `overlaps to ${Number(deepest.toPrecision(2))} of a radius: ${deepest < 0.1 ? "each contact is on its own" : "beyond 0.1 other contacts of a particle act on each: at 0.2 with 2.4 times the force (E*/Y = 100)"}`, deepest < 0.1 ? "good" : "fair"],
      ["velocity axis", b.velocity_axis_matters ? "inertia changes e: the law needs it" : "not needed", ""],
      ["stretch", soften.stretch > 1 ? `${Number(soften.stretch.toPrecision(3))}: steps of ${with_unit(soften.time_step_s, "s", 3)}, the same e; bound by the ${soften.bound_by}` : `none: bound by the ${soften.bound_by}`, ""],
      ...b.beyond_laws.map((sentence) => ["beyond all laws", sentence, "bad"]),
    ];
  }
  function show_bed() {
    const b = granulaw.bed_now({...request_of(state), bed_height: state.bed}), rows = b.problem ? [["no answer", `${b.problem}.`, "bad"]] : bed_rows(b);
    byId("needs").replaceChildren(...rows.flatMap(([name, text, kind]) => {
      const term = document.createElement("dt"), said = document.createElement("dd");
      term.textContent = name, said.textContent = text, said.className = kind;
      return [term, said];
    }));
  }

  // --- pictures
  const top_of = (list) => list.reduce((a, b) => Math.max(a, b), 0);
  function summit(curve) { const k = curve.overlap.indexOf(top_of(curve.overlap)); return [curve.overlap[k], curve.force[k]]; }
  // The unit of overlaps (docs/theory/law.md): at a rigid wall and between like spheres each sphere's overlap is over its R.
  const length_name = () => state.partner === "wall" || state.partner === "like" ? "R" : "λR*";
  function draw_loop() {
    const others = [["thornton", now.thornton.curve, "Thornton"], ...(then && !then.problem ? [["kept", then.curve, "kept"]] : [])];
    const yields = now.limits.yield_speed !== null && state.speed > now.limits.yield_speed, shown_curves = [["law", now.curve, "law"], ...(yields ? others : others.slice(1))];
    const force = 1.1 * Math.max(...shown_curves.map(([, c]) => top_of(c.force))), with_hertz = top_of(now.hertz.curve.force) < 1.8 * force;
    const overlap = 1.06 * Math.max(...shown_curves.map(([, c]) => top_of(c.overlap)));
    const p = new Picture(byId("loop"), {low: 0, high: overlap, label: "overlap δ", unit: "m"}, {low: 0, high: with_hertz ? Math.max(force, Math.min(1.8 * force, 1.06 * top_of(now.hertz.curve.force))) : force, label: "force F", unit: "N"},
      `Force against overlap: ${words_of(state)}`);
    p.area(now.curve.overlap, now.curve.force, "law");
    p.upright(now.onset_overlap ?? Infinity, "first yield");
    p.upright(0.1 * now.length, `0.1 ${length_name()}`);
    const deepest = now.hertz.curve.overlap.indexOf(top_of(now.hertz.curve.overlap)) + 1;  // it unloads along the same line
    p.line(now.hertz.curve.overlap.slice(0, deepest), now.hertz.curve.force.slice(0, deepest), "hertz");
    for (const [kind, curve, name] of shown_curves.slice().reverse()) {
      p.line(curve.overlap, curve.force, kind);
      p.label(...summit(curve), name, kind);
    }
    const h = now.hertz.curve, last = h.force.findLastIndex((f, k) => k < deepest && h.overlap[k] <= overlap && f <= p.y.high);
    p.label(h.overlap[Math.max(0, last)], h.force[Math.max(0, last)], "Hertz", "hertz");
    p.dot(...summit(now.curve), "law");
  }
  // [speed, e, sd] of the drop tests.
  const measured = () => { const m = drops.fit?.measurements?.[0]; return m ? m.x.map((v, k) => [v, m.measured[k], m.sd[k]]) : []; };
  const speed_axis = () => {
    const all = [now.sweep.speed[0], now.sweep.speed.at(-1), state.speed, ...(then && !then.problem ? [then.sweep.speed[0], then.sweep.speed.at(-1)] : []), ...measured().map(([v]) => v)];
    return {low: 0.8 * Math.min(...all), high: 1.8 * Math.max(...all), log: true, label: "approach speed V", unit: "m/s"};
  };
  function speed_zones(p) {
    const {yield_speed, bound_speed, end_speed} = now.limits, never = (v) => v ?? Infinity, stated = Math.min(never(bound_speed), never(end_speed));
    p.zone(p.x.low, never(yield_speed), "elastic", "elastic");
    p.zone(never(yield_speed), stated, "yields", "yields");
    p.zone(stated, never(end_speed), "unstated", "no error bound");
    p.zone(never(end_speed), p.x.high, "beyond", "beyond the law");
  }
  function draw_speeds() {
    const p = new Picture(byId("speeds"), speed_axis(), {low: 0, high: 1.15, label: "restitution e", unit: ""}, `Restitution against speed: ${words_of(state)}`), w = now.sweep;
    speed_zones(p);
    const known = w.speed.map((v, k) => k).filter((k) => w.error[k] !== null), up = known.map((k) => w.e[k] + w.error[k]), down = known.map((k) => w.e[k] - w.error[k]);
    p.area([...known.map((k) => w.speed[k]), ...known.map((k) => w.speed[k]).reverse()], [...up, ...down.reverse()], "band");
    p.line([p.x.low, p.x.high], [1, 1], "hertz");
    p.line(w.speed, w.thornton, "thornton");
    p.upright(now.limits.tenth_speed ?? Infinity, `0.1 ${length_name()} deep`);
    p.upright(state.speed, "", "now");
    if (then && !then.problem) p.line(then.sweep.speed, then.sweep.e, "kept"), p.dot(kept.speed, then.law.e, "kept"), p.label(then.sweep.speed.at(-1), then.sweep.e.at(-1), "kept", "kept");
    p.line(w.speed, w.e, "law");
    p.label(w.speed[22], w.e[22], "law", "law"), p.label(w.speed[36], w.thornton[36], "Thornton", "thornton", true), p.label(p.x.low * 1.1, 1, "Hertz", "hertz");
    for (const [v, e, sd] of measured()) p.line([v, v], [e - 1.96 * sd, e + 1.96 * sd], "data"), p.dot(v, e, "data").setAttribute("r", 4);
    const handle = p.dot(state.speed, now.law.e, "law");
    for (const [key, value] of Object.entries({tabindex: 0, role: "slider", "aria-label": "approach speed", "aria-valuetext": with_unit(state.speed, "m/s", 3), "aria-valuenow": state.speed, id: "handle"})) handle.setAttribute(key, value);
    handle.addEventListener("keydown", (event) => {
      const step = {ArrowRight: 1.05, ArrowUp: 1.05, ArrowLeft: 1 / 1.05, ArrowDown: 1 / 1.05, PageUp: 2, PageDown: 0.5}[event.key];
      if (step) event.preventDefault(), set_speed(state.speed * step);
    });
    picture_of_speeds = p;
  }
  let picture_of_speeds = null;
  function draw_range() {
    const w = now.sweep, limit = now.overlap_limit / now.length, onset = now.onset_overlap === null ? null : now.onset_overlap / now.length, low = 0.5 * Math.min(w.overlap[0] / now.length, onset ?? Infinity);
    const p = new Picture(byId("range"), speed_axis(), {low, high: Math.max(0.5, 2 * limit), log: true, label: `overlap/${length_name()}`, unit: ""}, `Range of the law: ${words_of(state)}`);
    speed_zones(p);
    if (onset !== null) p.level(onset, "first yield");
    p.level(0.1, `0.1 ${length_name()}: beyond, the support matters`), p.level(limit, "the law ends");
    p.line(w.speed, w.overlap.map((d) => d / now.length), "law");
    if (then && !then.problem) p.line(then.sweep.speed, then.sweep.overlap.map((d) => d / then.length), "kept"), p.dot(kept.speed, then.law.delta_max_m / then.length, "kept");
    p.upright(state.speed, "", "now");
    p.dot(state.speed, now.law.delta_max_m / now.length, "law");
  }
  function set_speed(value) { state.speed = Number(Math.min(1e4, Math.max(1e-6, value)).toPrecision(3)); problem = null; update(); }
  function add_drag() {
    const svg = byId("speeds"), move = (event) => { if (picture_of_speeds) set_speed(picture_of_speeds.x_of((event.clientX - svg.getBoundingClientRect().left) * picture_of_speeds.width / svg.getBoundingClientRect().width)); };
    svg.addEventListener("pointerdown", (event) => { svg.setPointerCapture(event.pointerId); move(event); });
    svg.addEventListener("pointermove", (event) => { if (event.buttons) move(event); });
  }

  // --- texts to copy
  const toml_of = (m) => [`[material.${m.name}]`, `density = ${m.density}`, `youngs_modulus = ${m.youngs_modulus}`, `poisson_ratio = ${m.poisson_ratio}`,
    ...(Number.isFinite(m.yield_stress) ? [`yield_stress = ${m.yield_stress}`] : []),
    ...(Number.isFinite(m.yield_stress) && m.hardening_modulus > 0 ? [`hardening = {law = "linear", modulus = ${m.hardening_modulus}}`] : [])].join("\n") + "\n";
  const is_pair = () => state.partner === "sphere" || state.partner === "thick";
  function own_name() { return is_pair() && state.second.name === state.first.name && typeof request_of(state).partner.material === "object" ? state.second.name + "-2" : state.second.name; }
  const has_second = () => is_pair() && own_name() + JSON.stringify(request_of(state).partner.material ?? "") !== state.first.name + '""';
  function texts() {
    const {first, second} = state, name2 = own_name(), two = has_second();
    const file = `${first.name}.h5`, pair = {wall: `${first.name}:wall`, like: `${first.name}:${first.name}`}[state.partner] ?? `${first.name}:${name2}`;
    const ratio = state.partner === "sphere" ? Math.min(10, Math.max(state.radius / state.radius2, state.radius2 / state.radius)) : 1;
    const table = `mpm table materials.toml --radius-ratio ${ratio}${state.partner === "thick" ? "" : " --no-thick-walls"} -o ${file}`;
    const radius2 = state.partner === "sphere" ? ` --radius2 ${state.radius2}` : state.partner === "thick" ? " --radius2 inf" : "";
    const rows = two ? [first, {...second, name: name2}] : [first], list = (key) => rows.map((m) => m[key]).join(" ");
    const step = now.problem ? null : Number((0.95 * now.limits.largest_time_step).toPrecision(2));
    const wall = (tail, type) => `fix floor all wall/gran model mpm tangential history primitive type ${type} zplane 0.0${tail}`;
    const w = now.problem ? null : now.sweep, c = now.problem ? null : now.curve;
    return {
      "materials.toml": `# ${first.source}\n${toml_of(first)}${two ? `\n# ${second.source}\n${toml_of({...second, name: name2})}` : ""}`,
      "in.deck": `# ${table}\n# mpm law ${file} --pair ${pair} --radius ${state.radius}${radius2} --velocity ${state.speed}\n# liggghts-mpm -in in.deck, with these lines:\n` +
        `hard_particles yes\nfix m1 all property/global youngsModulus peratomtype ${list("youngs_modulus")}\nfix m2 all property/global poissonsRatio peratomtype ${list("poisson_ratio")}\n` +
        `fix m3 all property/global coefficientFriction peratomtypepair ${rows.length} ${rows.flatMap(() => rows.map(() => 0.3)).join(" ")}    # assumed\n` +
        `pair_style gran model mpm tangential history &\n  law ${file} materials ${rows.map((m) => m.name).join(" ")}\npair_coeff * *\n` +
        `${state.partner === "thick" ? wall(" wall deformable", two ? 2 : 1) : wall("", 1)}\n` +
        (step === null ? "" : `timestep ${step}    # at most ${now.limits.largest_time_step.toPrecision(4)}, of every contact of these spheres\n`),
      "curves.csv": now.problem ? "" : "time_s,overlap_m,force_N\n" + c.time.map((t, k) => `${t},${c.overlap[k]},${c.force[k]}`).join("\n") +
        "\n\nspeed_m_s,e,error_e,e_thornton,largest_overlap_m\n" + w.speed.map((v, k) => `${v},${w.e[k]},${w.error[k] ?? ""},${w.thornton[k]},${w.overlap[k]}`).join("\n") + "\n",
      ...(drops_csv() ? {"drops.csv": `${drops_command()}\n${drops_csv()}`} : {}),
      "law.json": JSON.stringify(now.problem ? now : now.law, null, 2) + "\n",
    };
  }
  function show_text() {
    const all = texts(), focused = document.activeElement?.id ?? "";
    if (!(shown in all)) shown = "materials.toml";
    byId("text").textContent = all[shown];
    byId("tabs").replaceChildren(...Object.keys(all).map((name) => {
      const tab = document.createElement("button");
      tab.type = "button", tab.textContent = name, tab.id = `tab-${name}`;
      tab.setAttribute("role", "tab"), tab.setAttribute("aria-selected", `${name === shown}`);
      tab.addEventListener("click", () => { shown = name; show_text(); byId(`tab-${name}`).focus(); });
      return tab;
    }));
    if (focused.startsWith("tab-")) byId(focused)?.focus();
  }
  function download(name, text, type = "text/plain") {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([text], {type}));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }
  async function copy(text, button) {
    const before = button.textContent;
    try { await navigator.clipboard.writeText(text); button.textContent = "Copied"; } catch { prompt("Copy the text:", text); }
    setTimeout(() => { button.textContent = before; }, 1200);
  }
  // The picture alone, with its colours written into it.
  function svg_text(id) {
    const original = byId(id), twin = original.cloneNode(true), parts = twin.querySelectorAll("*");
    original.querySelectorAll("*").forEach((part, k) => {
      const style = getComputedStyle(part);
      parts[k].setAttribute("style", ["fill", "stroke", "stroke-width", "stroke-dasharray", "opacity", "font", "paint-order"].map((key) => `${key}:${style.getPropertyValue(key)}`).join(";"));
    });
    twin.setAttribute("xmlns", SVG);
    twin.setAttribute("style", `background:${getComputedStyle(document.body).getPropertyValue("--card")}`);
    return new XMLSerializer().serializeToString(twin);
  }
  function add_buttons() {
    byId("keep").addEventListener("click", () => { kept = structuredClone(state); update(); });
    byId("swap").addEventListener("click", () => { [state, kept] = [kept, state]; update(); });
    byId("forget").addEventListener("click", () => { kept = null; update(); });
    byId("share").addEventListener("click", () => copy(location.href, byId("share")));
    byId("copy").addEventListener("click", () => copy(texts()[shown], byId("copy")));
    byId("download").addEventListener("click", () => download(shown, texts()[shown]));
    document.querySelectorAll("[data-svg]").forEach((button) => {
      button.setAttribute("aria-label", `download the picture ${button.dataset.svg}.svg`);
      button.addEventListener("click", () => download(`${button.dataset.svg}.svg`, svg_text(button.dataset.svg), "image/svg+xml"));
    });
  }

  // --- all anew
  function refresh() {
    pending = false;
    const start = performance.now();
    now = granulaw.explore(request_of(state));
    then = kept ? granulaw.explore(request_of(kept)) : null;
    controls.forEach((control) => control());
    say(state, now);
    show_numbers();
    for (const id of ["loop", "speeds", "range"]) byId(id).closest("figure").hidden = Boolean(now.problem);
    if (!now.problem) draw_loop(), draw_speeds(), draw_range();
    byId("swap").hidden = byId("forget").hidden = !kept;
    show_text();
    to_address();
    if (focus_handle) byId("handle")?.focus();
    granulaw.last_change_ms = performance.now() - start;
    clearTimeout(later);
    later = setTimeout(refresh_rest, 120);
  }
  // The slower rest, once the hand rests.
  let later = 0;
  function refresh_rest() {
    const start = performance.now();
    fit_drops();
    show_bed();
    if (!now.problem) draw_speeds();
    show_text();
    if (focus_handle) byId("handle")?.focus();
    granulaw.last_rest_ms = performance.now() - start;
  }
  let focus_handle = false;
  function update() {
    if (pending) return;
    pending = true;
    focus_handle = document.activeElement?.id === "handle";
    requestAnimationFrame(refresh);
  }

  async function begin() {
    add_presets("preset", "first");
    OF_MATERIAL.forEach((key) => add_row(byId("rows"), key, () => state.first));
    add_row(byId("rows"), "radius", () => state);
    add_presets("preset2", "second");
    OF_MATERIAL.forEach((key) => add_row(byId("rows2"), key, () => state.second, "2"));
    add_row(byId("rows2"), "radius", () => state, "2");
    add_row(byId("rows3"), "speed", () => state);
    add_row(byId("rows3"), "fall", () => falling);
    add_row(byId("rows4"), "scatter", () => drops);
    add_row(byId("rows5"), "bed", () => state);
    add_drops();
    add_partners();
    add_drag();
    add_buttons();
    from_address();
    controls.forEach((control) => control());
    try {
      await granulaw.ready;
    } catch (failure) {
      byId("sentence").textContent = failure.message;
      byId("verdict").className = "bad";
      return;
    }
    refresh();
    granulaw.first_curve_ms = performance.now();
    addEventListener("resize", update);
    addEventListener("hashchange", () => { kept = null; from_address(); update(); });
    byId("controls").addEventListener("submit", (event) => event.preventDefault());
  }
  begin();
})();
