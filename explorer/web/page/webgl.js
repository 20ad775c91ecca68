// Drawing by WebGL2, pixel by pixel as the explorer does.
"use strict";

const vertexShader = `#version 300 es
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float value;
uniform mat4 projection, camera;
uniform vec2 range;
out vec3 seen, facing;
out float part;
void main() {
  vec4 place = camera * vec4(position, 1.0);
  seen = place.xyz;
  facing = mat3(camera) * normal;
  part = (value - range.x) / max(range.y - range.x, 1e-30);
  gl_Position = projection * place;
}`;
const fragmentShader = `#version 300 es
precision highp float;
in vec3 seen, facing;
in float part;
uniform sampler2D colors;
uniform vec4 plain;   // a colour, where its fourth number is 1
uniform vec4 look;    // ambient, diffuse, specular, its power
out vec4 shown;
void main() {
  vec3 n = normalize(facing);
  if (dot(n, -normalize(seen)) < 0.0) n = -n;
  vec3 color = plain.a > 0.5 ? plain.rgb : texture(colors, vec2(clamp(part, 0.0, 1.0) * 255.0 / 256.0 + 0.5 / 256.0, 0.5)).rgb;
  vec3 lights[3] = vec3[3](vec3(-0.7, 0.9, 1.0), vec3(0.5, -0.25, 1.0), vec3(0.2, 1.0, -0.8));
  vec3 tints[3] = vec3[3](0.80 * vec3(1.0, 1.0, 0.95), 0.50 * vec3(0.97, 1.0, 1.0), 0.25 * vec3(1.0));
  vec3 sum = look.x * color;
  for (int i = 0; i < 3; ++i) {
    vec3 l = normalize(lights[i]);
    float cosine = max(0.0, dot(n, l));
    vec3 mirrored = reflect(-l, n);
    float gloss = cosine > 0.0 ? pow(max(0.0, dot(mirrored, -normalize(seen))), look.w) : 0.0;
    sum += tints[i] * (look.y * cosine * color + look.z * gloss);
  }
  shown = vec4(sum, 1.0);
}`;

class WebglDrawing {
  /// Throws an Error where the browser has no WebGL2.
  constructor(canvas) {
    const gl = canvas.getContext("webgl2", {antialias: true, preserveDrawingBuffer: true});
    if (!gl) throw new Error("This browser has no WebGL2.");
    this.canvas = canvas, this.gl = gl;
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    gl.useProgram(program);
    this.places = {};
    for (const name of ["projection", "camera", "range", "colors", "plain", "look"])
      this.places[name] = gl.getUniformLocation(program, name);
    this.textures = new Map();
    this.buffers = [gl.createBuffer(), gl.createBuffer(), gl.createBuffer()];
    this.buffers.forEach((buffer, n) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.enableVertexAttribArray(n);
      gl.vertexAttribPointer(n, n < 2 ? 3 : 1, gl.FLOAT, false, 0, 0);
    });
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.enable(gl.DEPTH_TEST);
  }
  /// A table of 256 colours.
  textureOf(table) {
    const {gl} = this;
    let made = this.textures.get(table);
    if (made) return made;
    made = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, made);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, table);
    for (const [name, value] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
                                 [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]])
      gl.texParameteri(gl.TEXTURE_2D, name, value);
    this.textures.set(table, made);
    return made;
  }
  /// Parts of a surface as View.parts() has them; the camera is View.cameraAt()'s.
  draw(surface, camera, background, parts) {
    const {gl, canvas, places} = this, {axes: {right, up, back}, middle, distance, near, far, f, aspect} = camera;
    sizeCanvas(canvas, camera);
    gl.viewport(0, 0, camera.width, camera.height);
    gl.clearColor(...background, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    if (this.triangles !== surface.triangles) {
      this.triangles = surface.triangles;
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, this.triangles, gl.STATIC_DRAW);
    }
    const upload = (n, numbers) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[n]);
      gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.DYNAMIC_DRAW);
    };
    upload(0, surface.positions);
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    gl.uniformMatrix4fv(places.projection, false,
      [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0]);
    gl.uniformMatrix4fv(places.camera, false,
      [right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0,
       -dot(right, middle), -dot(up, middle), -dot(back, middle) - distance, 1]);
    for (const part of parts) {
      upload(1, part.normals);
      upload(2, part.values);
      gl.bindTexture(gl.TEXTURE_2D, this.textureOf(part.table));
      gl.uniform2fv(places.range, part.range);
      gl.uniform4fv(places.look, part.look);
      gl.uniform4fv(places.plain, part.plain ? [...part.plain, 1] : [0, 0, 0, 0]);
      gl.drawElements(gl.TRIANGLES, part.to - part.from, gl.UNSIGNED_INT, 4 * part.from);
    }
  }
  /// Waits until all is drawn.
  finish() { this.gl.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, new Uint8Array(4)); }
}
