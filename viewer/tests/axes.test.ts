import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import { Axes, axisDirections } from "../src/overlays/axes.ts";
import { fakePage, type FakeElement } from "./fake_page.ts";

function cameraAt(...p_S: [number, number, number]): THREE.Camera {
  const camera = new THREE.PerspectiveCamera();
  camera.up.set(0, 0, 1);
  camera.position.set(...p_S);
  camera.lookAt(0, 0, 0);
  camera.updateMatrixWorld();
  return camera;
}

test("the axes go where those of the world go in the picture", () => {
  for (const [place, x, y] of [[[-5, 0, 0], [0, 0, -1], [-1, 0, 0]], [[0, -5, 0], [1, 0, 0], [0, 0, -1]], [[5, 0, 0], [0, 0, 1], [1, 0, 0]]] as const) {
    const directions = axisDirections(cameraAt(...(place as unknown as [number, number, number]))).map((direction) => direction.map((one) => Math.round(one) + 0));
    assert.deepEqual(directions, [x, y, [0, 1, 0]], `seen from ${place}`);
  }
});

test("a letter stands where its axis ends, paler where it goes away", () => {
  fakePage();
  const axes = new Axes();
  const letters = (axes.root as unknown as FakeElement).children.slice(3);
  axes.turn(cameraAt(0, -5, 0));
  const told = letters.map((one) => [one.textContent, Number(one.getAttribute("x")), Number(one.getAttribute("y")), one.getAttribute("class")]);
  assert.deepEqual(told, [["x", 55, 30, ""], ["y", 30, 30, "away"], ["z", 30, 5, ""]]);
});
