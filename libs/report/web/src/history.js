// SPDX-License-Identifier: BSD-3-Clause
// What the map was like after each scan, from its tables of events and existence.
import { Matrix4 } from "three";

const RADIANS = Math.PI / 180;

/** The matrix of 16 numbers, row by row. */
export const matrixOf = (numbers) => new Matrix4().set(...numbers);

/** `[x y z yaw pitch roll]` (m, degrees) somewhere in a text; null if there is none. */
function motionIn(text) {
  const found = /\[([^\]]*)\]/.exec(text);
  const n = found ? found[1].trim().split(/\s+/).map(Number) : [];
  if (n.length !== 6 || n.some((value) => !Number.isFinite(value))) return null;
  const turn = new Matrix4()
    .makeRotationZ(n[3] * RADIANS)
    .multiply(new Matrix4().makeRotationY(n[4] * RADIANS))
    .multiply(new Matrix4().makeRotationX(n[5] * RADIANS));
  return turn.setPosition(n[0], n[1], n[2]);
}

export class History {
  constructor(map) {
    this.map = map;
    this.lastScan = Math.max(0, map.scans - 1);
    this.nodes = [...map.nodes, ...map.removed];
    this.byId = new Map(this.nodes.map((node) => [node.id, node]));
    this.lives = new Map(this.nodes.map((node) => [node.id, this.#lifeOf(node)]));
    for (const row of map.existence) {
      this.lives.get(row[1])?.existence.push({ scan: row[0], value: row[5] });
    }
    this.#findMotions();
  }

  #lifeOf(node) {
    const events = this.map.events.filter((event) => event.node === node.id);
    const begin = events.find((event) => event.event === "created" || event.event === "split");
    const end = events.filter((event) => event.event === "removed" || event.event === "merged").at(-1);
    return {
      from: node.id === 0 ? 0 : (begin?.scan ?? node.first_scan),
      until: end?.scan ?? node.removed_scan ?? Infinity,
      existence: [{ scan: begin?.scan ?? 0, value: begin?.existence ?? node.existence }],
      pose: matrixOf(node.world_pose_matrix),
      motions: [], // of the world, latest first: takes the pose after `scan` to that before
    };
  }

  #isBelow(id, ancestor) {
    for (let node = this.byId.get(id); node; node = this.byId.get(node.parent)) {
      if (node.id === ancestor) return true;
    }
    return false;
  }

  /** Goes back in time from the last poses. Children follow what they stand on. */
  #findMotions() {
    for (const event of [...this.map.events].reverse()) {
      if (event.event !== "moved" && event.event !== "reidentified") continue;
      const motion = motionIn(event.detail);
      const moved = this.lives.get(event.node);
      if (!motion || !moved) continue;
      const back = motion.clone().invert();
      if (event.event === "moved") {
        const after = this.poseAt(event.node, event.scan);
        back.premultiply(after).multiply(after.clone().invert()); // told in the node's frame
      }
      for (const [id, life] of this.lives) {
        if (life.from <= event.scan && life.until >= event.scan && this.#isBelow(id, event.node)) {
          life.motions.push({ scan: event.scan, back });
        }
      }
    }
  }

  isThere(id, scan) {
    const life = this.lives.get(id);
    return life.from <= scan && scan < life.until;
  }

  poseAt(id, scan) {
    const life = this.lives.get(id);
    const pose = life.pose.clone();
    for (const { scan: when, back } of life.motions) {
      if (when > scan) pose.premultiply(back);
    }
    return pose;
  }

  existenceAt(id, scan) {
    let value = null;
    for (const entry of this.lives.get(id).existence) {
      if (entry.scan <= scan) value = entry.value;
    }
    return value ?? this.byId.get(id).existence;
  }

  /** Existence at each scan, as far as the node is there; null elsewhere. */
  curve(id) {
    const { from, until, existence } = this.lives.get(id);
    const values = new Array(this.map.scans).fill(null);
    let i = 0;
    for (let scan = from; scan < this.map.scans && scan <= until; ++scan) {
      while (i + 1 < existence.length && existence[i + 1].scan <= scan) ++i;
      values[scan] = existence[i].value;
    }
    return values;
  }
}
