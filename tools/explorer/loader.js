// The module: opens it and the atlas, and carries requests to it as JSON (explorer.cpp).
const granulaw = (() => {
  let exported = null;

  async function inflated(text) {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  // Doubles from bytes that lie sorted by their place in a double.
  function unshuffled(bytes) {
    const count = bytes.length / 8, all = new Uint8Array(bytes.length);
    for (let place = 0; place < 8; ++place)
      for (let k = 0; k < count; ++k) all[8 * k + place] = bytes[place * count + k];
    return new Float64Array(all.buffer);
  }

  // Functions of the operating system that the module imports. It asks for the time alone.
  function imports_of(module) {
    const imports = {};
    for (const {module: from, name} of WebAssembly.Module.imports(module)) {
      imports[from] ??= {};
      imports[from][name] = name === "clock_time_get" ? (id, precision, at) => {
        new DataView(exported.memory.buffer).setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
        return 0;
      } : () => 52;  // not implemented
    }
    return imports;
  }

  function text_at(at) {
    const bytes = new Uint8Array(exported.memory.buffer);
    return new TextDecoder().decode(bytes.slice(at, bytes.indexOf(0, at)));
  }

  function asked(name, request) {
    const text = JSON.stringify(request, (key, value) => (typeof value === "number" && Number.isNaN(value) ? "NaN" : value));
    const bytes = new TextEncoder().encode((text ?? "null") + "\0"), at = exported.malloc(bytes.length);
    new Uint8Array(exported.memory.buffer).set(bytes, at);
    const answer = JSON.parse(text_at(exported[name](at)));
    exported.free(at);
    return answer;
  }

  async function open() {
    if (typeof WebAssembly === "undefined" || typeof DecompressionStream === "undefined")
      throw new Error("The browser is too old: Chrome 103, Firefox 113 or Safari 16.4 is needed.");
    const module = await WebAssembly.compile(await inflated(MODULE_TEXT));
    exported = (await WebAssembly.instantiate(module, imports_of(module))).exports;
    exported._initialize?.();
    const numbers = unshuffled(await inflated(ATLAS_TEXT)), at = exported.malloc(8 * numbers.length);
    new Float64Array(exported.memory.buffer, at, numbers.length).set(numbers);
    const opened = JSON.parse(text_at(exported.granulaw_open(at, numbers.length)));
    exported.free(at);
    if (opened.problem) throw new Error(opened.problem);
    return opened;
  }

  const ready = open();
  ready.catch(() => {});  // whoever awaits it gets the reason
  return {
    ready,
    // One collision: the object of `mpm law --json`, or {problem}. Infinity as yield stress: elastic; as radius of the
    // partner: a thick deformable wall.
    law: async (request) => (await ready, asked("granulaw_law", request)),
    // The same with curves and limits, once `ready`.
    explore: (request) => asked("granulaw_explore", request),
    // Yield stress of drop tests, the object of `mpm calibrate --json`: {data: CSV, relative_sd, material, radius, partner}.
    calibrate: async (request) => (await ready, asked("granulaw_calibrate", request)),
    calibrate_now: (request) => asked("granulaw_calibrate", request),
    // Requirements of a bed, with the keys of `mpm plan --json` and `mpm stretch --json`: a state with bed_height, m.
    bed: async (request) => (await ready, asked("granulaw_bed", request)),
    bed_now: (request) => asked("granulaw_bed", request),
  };
})();
globalThis.granulaw = granulaw;
