import assert from "node:assert/strict";
import { test } from "node:test";
import { withoutCardText } from "../src/panels/without_card.ts";

test("where the processor draws it is told how to see the run on a machine with a graphics card", () => {
  for (const host of ["127.0.0.1", "localhost", "[::1]"]) assert.match(withoutCardText(host, "7373")[1], /hardware acceleration.*ssh -L 7373:127\.0\.0\.1:7373 THIS_MACHINE/);
  const [, todo] = withoutCardText("10.0.0.5", "7373");
  assert.ok(!todo.includes("ssh") && todo.includes("open this link on a machine with a graphics card"), "it can be reached already");
});
