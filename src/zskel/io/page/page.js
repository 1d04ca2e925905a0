import * as THREE from 'three';
import { OrbitControls } from 'three/orbit';

const read = (id) => JSON.parse(document.getElementById(id).textContent);
const element = (id) => document.getElementById(id);
const bytesOf = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
const short = (x) => (Number.isFinite(x) ? Number(x.toPrecision(4)).toString() : 'none');

const skeleton = read('skeleton');
const scene = read('scene');
const nodes = skeleton.nodes;
const branches = skeleton.branches.map((branch, number) => ({ number, ...branch }));
const state = { node: -1, branch: -1 };

// ---- words

function make(name, text, parent, className) {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  if (className) made.className = className;
  if (parent) parent.append(made);
  return made;
}

function tellSummary() {
  const s = skeleton.statistics;
  element('summary').textContent = `${s.faces} faces, ${s.vertices} vertices; skeleton of ${nodes.length} nodes, ` +
    `${skeleton.edges.length} edges, ${branches.length} branches, ${skeleton.self_check.components} components, ` +
    `${skeleton.self_check.cycles} cycles`;
}

function tellChecks() {
  const list = element('warning-list');
  const check = skeleton.self_check;
  make('li', `components ${check.components} of ${check.expected_components ?? 'no'} expected`, list);
  make('li', `cycles ${check.cycles} of ${check.expected_cycles ?? 'no'} expected`, list);
  if (check.share_inside !== null) make('li', `${short(100 * check.share_inside)} % inside`, list);
  make('li', check.is_sound ? 'the self-check found nothing wrong' : 'the self-check failed', list,
    check.is_sound ? 'good' : 'bad');
  for (const text of [...check.failures, ...skeleton.warnings]) {
    make('li', typeof text === 'string' ? text : JSON.stringify(text), list, 'bad');
  }
}

function tellProvenance() {
  const list = element('provenance');
  const tell = (key, value) => {
    if (value !== null && typeof value === 'object' && !Array.isArray(value)) {
      for (const [inner, v] of Object.entries(value)) tell(`${key}: ${inner}`, v);
    } else {
      make('dt', key.replaceAll('_', ' '), list);
      make('dd', Array.isArray(value) ? JSON.stringify(value) : String(value), list);
    }
  };
  for (const [key, value] of Object.entries(skeleton.provenance)) tell(key, value);
  for (const [key, value] of Object.entries(skeleton.statistics)) tell(`statistics: ${key}`, value);
}

// ---- plots

const kWidth = 400;
const kHeight = 150;
const kMargin = { left: 52, right: 8, top: 8, bottom: 24 };

function svgOf(height, body) {
  return `<svg viewBox="0 0 ${kWidth} ${height}" role="img">${body}</svg>`;
}

function frame(xMost, yMost, height) {
  const bottom = height - kMargin.bottom;
  const right = kWidth - kMargin.right;
  return `<path class="axis" fill="none" d="M${kMargin.left} ${kMargin.top}V${bottom}H${right}"/>` +
    `<text x="${kMargin.left - 4}" y="${kMargin.top + 10}" text-anchor="end">${short(yMost)}</text>` +
    `<text x="${kMargin.left - 4}" y="${bottom}" text-anchor="end">0</text>` +
    `<text x="${right}" y="${height - 8}" text-anchor="end">${short(xMost)}</text>` +
    `<text x="${kMargin.left}" y="${height - 8}">0</text>`;
}

const distance = (a, b) => Math.hypot(...a.position.map((x, k) => x - b.position[k]));

function plotRadius(number) {
  const branch = branches[number];
  if (!branch) return;
  let way = 0;
  const points = branch.nodes.map((n, i) => {
    if (i > 0) way += distance(nodes[n], nodes[branch.nodes[i - 1]]);
    return [way, nodes[n].radius];
  });
  const most = Math.max(...points.map((p) => p[1]), Number.MIN_VALUE);
  const x = (value) => kMargin.left + value / (way || 1) * (kWidth - kMargin.left - kMargin.right);
  const y = (value) => kHeight - kMargin.bottom - value / most * (kHeight - kMargin.top - kMargin.bottom);
  const line = points.map(([a, b], i) => `${i ? 'L' : 'M'}${x(a).toFixed(1)} ${y(b).toFixed(1)}`).join('');
  element('radius-plot').innerHTML = svgOf(kHeight, frame(way, most, kHeight) + `<path class="curve" d="${line}"/>`);
}

// How much of the skeleton's length is how thick.
function plotHistogram() {
  const kBins = 24;
  const most = Math.max(...nodes.map((n) => n.radius), Number.MIN_VALUE);
  const bins = new Array(kBins).fill(0);
  for (const edge of skeleton.edges) {
    const a = nodes[edge.source];
    const b = nodes[edge.target];
    const bin = Math.min(kBins - 1, Math.floor((a.radius + b.radius) / 2 / most * kBins));
    bins[bin] += distance(a, b);
  }
  const highest = Math.max(...bins, Number.MIN_VALUE);
  const width = (kWidth - kMargin.left - kMargin.right) / kBins;
  const bars = bins.map((length, i) => {
    const height = length / highest * (kHeight - kMargin.top - kMargin.bottom);
    return `<rect class="bar" x="${(kMargin.left + i * width + 0.5).toFixed(1)}" ` +
      `y="${(kHeight - kMargin.bottom - height).toFixed(1)}" width="${(width - 1).toFixed(1)}" height="${height.toFixed(1)}"/>`;
  });
  element('radius-histogram').innerHTML = svgOf(kHeight, frame(most, highest, kHeight) + bars.join(''));
}

function plotLengths() {
  const kMostBars = 30;
  const kBar = 12;
  const longest = [...branches].sort((a, b) => b.length - a.length).slice(0, kMostBars);
  const most = Math.max(...longest.map((b) => b.length), Number.MIN_VALUE);
  const bars = longest.map((branch, i) => {
    const width = branch.length / most * (kWidth - kMargin.left - 60);
    const chosen = branch.number === state.branch ? ' chosen' : '';
    return `<g data-branch="${branch.number}"><rect class="bar${chosen}" x="${kMargin.left}" y="${i * (kBar + 3)}" ` +
      `width="${width.toFixed(1)}" height="${kBar}"/>` +
      `<text x="${kMargin.left - 4}" y="${i * (kBar + 3) + 10}" text-anchor="end">${branch.number}</text>` +
      `<text x="${(kMargin.left + width + 4).toFixed(1)}" y="${i * (kBar + 3) + 10}">${short(branch.length)}</text></g>`;
  });
  element('length-plot').innerHTML = longest.length ? svgOf(longest.length * (kBar + 3), bars.join('')) : 'No branches.';
  for (const bar of element('length-plot').querySelectorAll('g')) {
    bar.addEventListener('click', () => chooseBranch(Number(bar.dataset.branch)));
  }
}

// ---- table

let sortKey = 'number';
let sortsDown = false;

function fillTable() {
  const value = (branch) => (sortKey === 'nodes' ? branch.nodes.length : branch[sortKey]);
  const sorted = [...branches].sort((a, b) => (value(a) < value(b) ? -1 : value(a) > value(b) ? 1 : 0) * (sortsDown ? -1 : 1));
  const body = element('branches').querySelector('tbody');
  body.replaceChildren();
  for (const branch of sorted) {
    const row = make('tr', undefined, body, branch.number === state.branch ? 'chosen' : '');
    for (const text of [branch.number, branch.from, branch.to, branch.nodes.length, short(branch.length),
      short(branch.mean_radius), branch.tortuosity === null ? 'none' : short(branch.tortuosity)]) make('td', text, row);
    row.addEventListener('click', () => chooseBranch(branch.number));
  }
}

for (const head of element('branches').querySelectorAll('th')) {
  head.addEventListener('click', () => {
    sortsDown = sortKey === head.dataset.key && !sortsDown;
    sortKey = head.dataset.key;
    fillTable();
  });
}

// ---- visibility maps

const mapCodes = (async () => {
  const stream = new Blob([bytesOf(scene.maps.codes)]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
})();

// Six faces, near white and far dark; what sees nothing is blue.
async function showMap(node) {
  const codes = await mapCodes;
  if (node !== state.node) return;
  const px = scene.maps.face_px;
  const holder = element('map');
  holder.replaceChildren();
  ['+x', '-x', '+y', '-y', '+z', '-z'].forEach((name, face) => {
    const figure = make('figure', undefined, holder);
    const canvas = make('canvas', undefined, figure);
    canvas.width = canvas.height = px;
    make('figcaption', name, figure);
    const image = new ImageData(px, px);
    for (let row = 0; row < px; ++row) {
      for (let column = 0; column < px; ++column) {
        const code = codes[((node * 6 + face) * px + row) * px + column];
        const grey = 255 - code * 0.9;
        image.data.set(code ? [grey, grey, grey, 255] : [0, 114, 178, 255], 4 * ((px - 1 - row) * px + column));
      }
    }
    canvas.getContext('2d').putImageData(image, 0, 0);
  });
  holder.dataset.node = node;
}

// ---- 3D

const kindColor = (degree) => (degree === 2 ? 0x33383f : degree < 2 ? 0xd65f00 : 0x0072b2);
const kChosen = new THREE.Color(0xe69f00);

class View {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color(0xffffff);
    this.camera = new THREE.PerspectiveCamera(35, 1, 0.01, 100);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.draw());
    this.places = nodes.map((node) => new THREE.Vector3(
      ...node.position.map((x, k) => (x - scene.center[k]) * scene.scale)));
    this.addLights();
    this.addSurface();
    this.addSkeleton();
    this.reset();
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  addLights() {
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0xb0b0a8, 1.8));
    const light = new THREE.DirectionalLight(0xffffff, 1.6);
    light.position.set(1, 2, 3);
    this.scene.add(light);
  }

  addSurface() {
    const geometry = new THREE.BufferGeometry();
    const positions = new Float32Array(bytesOf(scene.positions).buffer);
    geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
    geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(bytesOf(scene.triangles).buffer), 1));
    geometry.computeVertexNormals();
    const material = new THREE.MeshLambertMaterial(
      { color: 0xccc9bf, transparent: true, opacity: 0.3, depthWrite: false, side: THREE.DoubleSide });
    this.surface = new THREE.Mesh(geometry, material);
    geometry.computeBoundingSphere();
    this.sphere = geometry.boundingSphere;
    this.scene.add(this.surface);
  }

  addSkeleton() {
    const size = this.sphere.radius;
    const degrees = new Array(nodes.length).fill(0);
    for (const edge of skeleton.edges) {
      ++degrees[edge.source];
      ++degrees[edge.target];
    }
    const place = new THREE.Matrix4();
    const up = new THREE.Vector3(0, 1, 0);
    this.tubes = new THREE.InstancedMesh(new THREE.CylinderGeometry(1, 1, 1, 8),
      new THREE.MeshLambertMaterial(), skeleton.edges.length);
    skeleton.edges.forEach((edge, i) => {
      const along = this.places[edge.target].clone().sub(this.places[edge.source]);
      const length = Math.max(along.length(), 1e-9);
      const middle = this.places[edge.source].clone().addScaledVector(along, 0.5);
      const turn = new THREE.Quaternion().setFromUnitVectors(up, along.divideScalar(length));
      this.tubes.setMatrixAt(i, place.compose(middle, turn, new THREE.Vector3(0.005 * size, length, 0.005 * size)));
    });
    this.balls = new THREE.InstancedMesh(new THREE.SphereGeometry(1, 16, 12), new THREE.MeshLambertMaterial(),
      nodes.length);
    nodes.forEach((node, i) => {
      const radius = (degrees[i] === 2 ? 0.008 : 0.014) * size;
      this.balls.setMatrixAt(i, place.makeScale(radius, radius, radius).setPosition(this.places[i]));
    });
    this.degrees = degrees;
    this.inscribed = new THREE.Mesh(new THREE.SphereGeometry(1, 48, 32), new THREE.MeshLambertMaterial(
      { color: kChosen, transparent: true, opacity: 0.35, depthWrite: false }));
    this.inscribed.visible = false;
    this.scene.add(this.tubes, this.balls, this.inscribed);
    this.paint();
  }

  // Colours by kind, what is chosen apart.
  paint() {
    const branch = branches[state.branch];
    const edgesOf = new Set();
    if (branch) branch.nodes.forEach((n, i) => i && edgesOf.add([n, branch.nodes[i - 1]].sort((a, b) => a - b).join()));
    const color = new THREE.Color();
    skeleton.edges.forEach((edge, i) => {
      const isChosen = edgesOf.has([edge.source, edge.target].sort((a, b) => a - b).join());
      this.tubes.setColorAt(i, isChosen ? kChosen : color.set(0x33383f));
    });
    nodes.forEach((node, i) => this.balls.setColorAt(i, i === state.node ? kChosen : color.set(kindColor(this.degrees[i]))));
    for (const mesh of [this.tubes, this.balls]) if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    const node = nodes[state.node];
    this.inscribed.visible = Boolean(node);
    if (node) {
      this.inscribed.position.copy(this.places[state.node]);
      this.inscribed.scale.setScalar(Math.max(node.radius * scene.scale, 1e-9));
    }
  }

  reset() {
    const away = this.sphere.radius / Math.sin(THREE.MathUtils.degToRad(35 / 2));
    this.controls.target.copy(this.sphere.center);
    this.camera.position.copy(this.sphere.center).add(new THREE.Vector3(0.35, 0.25, 1).setLength(away));
    this.camera.near = away / 100;
    this.camera.far = away * 100;
    this.camera.updateProjectionMatrix();
    this.controls.update();
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    this.renderer.render(this.scene, this.camera);
  }

  // Where a node is seen, in the window's pixels.
  seen(node) {
    const box = this.canvas.getBoundingClientRect();
    const at = this.places[node].clone().project(this.camera);
    return { x: box.left + (at.x + 1) / 2 * box.width, y: box.top + (1 - at.y) / 2 * box.height, depth: at.z };
  }

  // The nearest node within a finger's width, the one in front where several are.
  nodeAt(x, y) {
    const kReach = 12;
    let best = -1;
    let least = Infinity;
    for (let n = 0; n < nodes.length; ++n) {
      const at = this.seen(n);
      const off = Math.hypot(at.x - x, at.y - y);
      if (off > kReach) continue;
      const rank = off + 4 * at.depth;
      if (rank < least) [least, best] = [rank, n];
    }
    return best;
  }
}

// ---- what is chosen

let view = null;

function chooseBranch(number) {
  state.branch = number;
  element('branch-choice').value = String(number);
  plotRadius(number);
  plotLengths();
  fillTable();
  if (view) {
    view.paint();
    view.draw();
  }
}

function chooseNode(number) {
  state.node = number;
  const node = nodes[number];
  const own = branches.filter((branch) => branch.nodes.includes(number));
  element('node').textContent = `Node ${number} at (${node.position.map(short).join(', ')}), radius ${short(node.radius)}, ` +
    `volume ${short(node.volume)}, on branch ${own.map((b) => b.number).join(', ') || 'none'}. What it sees, near to far:`;
  showMap(number);
  if (own.length > 0 && !own.some((branch) => branch.number === state.branch)) state.branch = own[0].number;
  if (state.branch >= 0) chooseBranch(state.branch);
  if (view) {
    view.paint();
    view.draw();
  }
}

function openView() {
  try {
    view = new View(element('canvas'));
  } catch (error) {
    element('no-view').hidden = false;
    element('no-view').textContent = `There is no 3D view: ${error.message}`;
    return;
  }
  let down = null;
  const canvas = element('canvas');
  canvas.addEventListener('pointerdown', (event) => { down = [event.clientX, event.clientY]; });
  canvas.addEventListener('pointerup', (event) => {
    if (!down || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4) return;
    const node = view.nodeAt(event.clientX, event.clientY);
    if (node >= 0) chooseNode(node);
  });
  element('show-surface').addEventListener('change', (event) => {
    view.surface.visible = event.target.checked;
    view.draw();
  });
  element('opacity').addEventListener('input', (event) => {
    view.surface.material.opacity = Number(event.target.value);
    view.draw();
  });
  element('reset').addEventListener('click', () => view.reset());
}

tellSummary();
tellChecks();
tellProvenance();
for (const branch of branches) {
  make('option', `branch ${branch.number}`, element('branch-choice')).value = branch.number;
}
element('branch-choice').addEventListener('change', (event) => chooseBranch(Number(event.target.value)));
plotHistogram();
plotLengths();
fillTable();
openView();
if (branches.length > 0) {
  chooseBranch(branches.reduce((best, branch) => (branch.length > best.length ? branch : best)).number);
}
window.zskel = { seen: (node) => view.seen(node), state };
document.body.dataset.ready = 'yes';
