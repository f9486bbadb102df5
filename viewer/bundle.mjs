// Makes the page that the program serves. Runs in the folder that holds node_modules:
//
//   node bundle.mjs VIEWER OUTPUT    type check, bundle, and OUTPUT/page_files.cpp with all files in it
//   node bundle.mjs VIEWER --test    bundle the tests and run them
import { spawnSync } from "node:child_process";
import { mkdirSync, readdirSync, copyFileSync, writeFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import process from "node:process";

const [viewer, output] = process.argv.slice(2).map((argument) => (argument === "--test" ? argument : path.resolve(argument)));
const modules = path.resolve("node_modules");
const esbuild = createRequire(path.join(modules, "here.js"))("esbuild");
const common = { bundle: true, nodePaths: [modules], logLevel: "warning", target: "es2022" };

function fail(text) {
  console.error(text);
  process.exit(1);
}

function run(script, args) {
  const { status } = spawnSync(process.execPath, [script, ...args], { stdio: "inherit" });
  if (status !== 0) process.exit(status ?? 1);
}

// The sources lie elsewhere than the packages: this tells the compiler where those are.
function checkTypes() {
  const config = {
    extends: path.join(viewer, "tsconfig.json"),
    compilerOptions: { paths: { "*": [`${modules}/@types/*`, `${modules}/*`] }, typeRoots: [`${modules}/@types`], types: ["node"] },
    include: [path.join(viewer, "src"), path.join(viewer, "tests")],
  };
  writeFileSync("tsconfig.json", JSON.stringify(config, null, 2));
  run(path.join(modules, "typescript/bin/tsc"), ["--project", "tsconfig.json", "--pretty"]);
}

async function bundlePage() {
  mkdirSync(output, { recursive: true });
  await esbuild.build({ ...common, entryPoints: { viewer: path.join(viewer, "src/main.ts") }, outdir: output, format: "esm", minify: true, legalComments: "eof" });
  for (const name of ["index.html", "icon.svg"]) copyFileSync(path.join(viewer, "src", name), path.join(output, name));
}

const FILES = { "index.html": "text/html; charset=utf-8", "viewer.js": "text/javascript; charset=utf-8", "viewer.css": "text/css; charset=utf-8", "icon.svg": "image/svg+xml" };

function writeSource() {
  const names = Object.keys(FILES);
  const blocks = names.map((name, k) => `asm(R"(
  .section .rodata
  .globl surefoot_page_${k}
  .hidden surefoot_page_${k}
surefoot_page_${k}:
  .incbin "${path.join(output, name)}"
  .globl surefoot_page_${k}_end
  .hidden surefoot_page_${k}_end
surefoot_page_${k}_end:
  .byte 0
  .previous
)");
extern "C" const char surefoot_page_${k}[], surefoot_page_${k}_end[];`);
  const entry = (name, k) => `    {"${name}", "${FILES[name]}", {surefoot_page_${k}, static_cast<std::size_t>(surefoot_page_${k}_end - surefoot_page_${k})}},`;
  writeFileSync(path.join(output, "page_files.cpp"), `// Made by viewer/bundle.mjs.
#include "server/page_files.hpp"

#include <array>
#include <cstddef>

${blocks.join("\n")}

namespace surefoot::server {

std::span<const PageFile> page_files() {
  static const std::array<PageFile, ${names.length}> files{{
${names.map(entry).join("\n")}
  }};
  return files;
}

}  // namespace surefoot::server
`);
}

async function runTests() {
  const tests = path.resolve("tests");
  rmSync(tests, { recursive: true, force: true });
  const entryPoints = readdirSync(path.join(viewer, "tests")).filter((name) => name.endsWith(".test.ts")).map((name) => path.join(viewer, "tests", name));
  if (entryPoints.length === 0) fail(`There are no tests in ${viewer}/tests.`);
  await esbuild.build({ ...common, entryPoints, outdir: tests, outExtension: { ".js": ".mjs" }, format: "esm", platform: "node", sourcemap: "inline", loader: { ".cpp": "text", ".hpp": "text", ".html": "text" } });
  const files = readdirSync(tests).map((name) => path.join(tests, name));
  const { status } = spawnSync(process.execPath, ["--enable-source-maps", "--test", ...files], { stdio: "inherit" });
  process.exit(status ?? 1);
}

checkTypes();
if (output === "--test") await runTests();
else {
  await bundlePage();
  writeSource();
}
