// One canvas that vtk.js draws a mesh on. Values are places on a texture of one ramp of colours, so that
// another range or colour map needs no other mesh.

import '@kitware/vtk.js/Rendering/Profiles/Geometry';
import vtkCellArray from '@kitware/vtk.js/Common/Core/CellArray';
import vtkDataArray from '@kitware/vtk.js/Common/Core/DataArray';
import vtkPolyData from '@kitware/vtk.js/Common/DataModel/PolyData';
import vtkActor from '@kitware/vtk.js/Rendering/Core/Actor';
import vtkMapper from '@kitware/vtk.js/Rendering/Core/Mapper';
import vtkRenderer from '@kitware/vtk.js/Rendering/Core/Renderer';
import vtkRenderWindow from '@kitware/vtk.js/Rendering/Core/RenderWindow';
import vtkTexture from '@kitware/vtk.js/Rendering/Core/Texture';
import vtkOpenGLRenderWindow from '@kitware/vtk.js/Rendering/OpenGL/RenderWindow';

import type { Camera } from './camera';
import { missingColour, paler, rampOf, slackAlong, type ColourScale, type Rgb } from './colour';
import { rampImage, textureRows } from './ramp_image';
import type { Style } from './store';

const rampColours = 1024;
const texels = rampColours + 2; // the colours of values outside the range at its ends
// Rows of the texture: their middles.
const rampRow = 1 / 6;
const paleRow = 1 / 2;
const missingRow = 5 / 6;
const missingPlace = 50; // as far off the others that cells with such a corner have it all over
const coarsePoints = 40_000;

export interface Mesh {
    xyz: Float32Array;
    normals: Float32Array | null;
    triangles: Uint32Array;
    segments: Uint32Array; // what has no triangles next to it; with style lines, all of the way
    points: Uint32Array; // vertices that are drawn
}

/** Vertex normals, up, the sum of the triangles'. */
export function normalsOf(xyz: Float32Array, triangles: Uint32Array): Float32Array {
    const normals = new Float32Array(xyz.length);
    for (let t = 0; t + 2 < triangles.length; t += 3) {
        const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
        const [ux, uy, uz] = [xyz[b] - xyz[a], xyz[b + 1] - xyz[a + 1], xyz[b + 2] - xyz[a + 2]];
        const [vx, vy, vz] = [xyz[c] - xyz[a], xyz[c + 1] - xyz[a + 1], xyz[c + 2] - xyz[a + 2]];
        let [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
        if (nz < 0) [nx, ny, nz] = [-nx, -ny, -nz];
        for (const v of [a, b, c]) {
            normals[v] += nx;
            normals[v + 1] += ny;
            normals[v + 2] += nz;
        }
    }
    for (let v = 0; v < normals.length; v += 3) {
        const length = Math.hypot(normals[v], normals[v + 1], normals[v + 2]);
        if (length > 0) for (let k = 0; k < 3; ++k) normals[v + k] /= length;
        else normals[v + 2] = 1;
    }
    return normals;
}

/** Cells of `size` corners, each with its size before it, as vtk.js wants them. */
function cells(corners: Uint32Array, size: number): Uint32Array {
    const out = new Uint32Array((corners.length / size) * (size + 1));
    for (let i = 0, at = 0; i < corners.length; i += size) {
        out[at++] = size;
        for (let k = 0; k < size; ++k) out[at++] = corners[i + k];
    }
    return out;
}

/**
 * Of a pixel that a triangle covers in part, the colour is that of a place inside the triangle. Else it is that of the middle
 * of the pixel, which may lie outside, where the ramp goes on to the colours of values beyond its ends: dots along each edge.
 */
function keepToCovered(): object[] {
    const declared = 'varying vec2 tcoordVCVSOutput';
    const replacement = {
        originalValue: declared,
        replaceFirst: false,
        replacementValue: `centroid ${declared}`,
        replaceAll: true,
    };
    return ['Vertex', 'Fragment'].map((shaderType) => ({ shaderType, ...replacement }));
}

/**
 * Cells of which a corner has no value are hatched, as `render` hatches them: any grey could be the colour of a value. Their
 * places lie off the rows of the ramp; the last row has the colour between the lines, then that of the lines.
 */
function hatchMissing(): object {
    const place = '//VTK::TCoord::Impl';
    const replacementValue = `${place}
  if (tcoordVCVSOutput.y > ${(paleRow + 0.02).toFixed(2)}) {
    bool onLine = mod(gl_FragCoord.x + gl_FragCoord.y, 8.0) < 1.5;
    ambientColor = diffuseColor = texture2D(texture1, vec2(onLine ? 0.9 : 0.1, ${missingRow.toFixed(4)})).rgb;
  }
`;
    return { shaderType: 'Fragment', originalValue: place, replaceFirst: true, replacementValue, replaceAll: false };
}

function replaceInShaders(mapper: vtkMapper, replacements: object[]): void {
    mapper.setViewSpecificProperties({ OpenGL: { ShaderReplacements: replacements } });
}

export class GlView {
    readonly canvas: HTMLCanvasElement;
    private readonly window = vtkRenderWindow.newInstance();
    private readonly renderer = vtkRenderer.newInstance();
    private readonly gl = vtkOpenGLRenderWindow.newInstance();
    private readonly actor = vtkActor.newInstance();
    private readonly mapper = vtkMapper.newInstance();
    private readonly data = vtkPolyData.newInstance();
    private readonly coarse = vtkActor.newInstance({ visibility: false }); // what stands for a mesh while a slow machine turns it
    private readonly coarseData = vtkPolyData.newInstance();
    private readonly path = vtkActor.newInstance({ visibility: false }); // as it is programmed
    private readonly pathData = vtkPolyData.newInstance();
    private background: Rgb = [255, 255, 255];
    private radius = 1;
    private middle = [0, 0, 0];
    private coarseVertices = new Uint32Array(0);

    constructor(container: HTMLElement) {
        this.window.addView(this.gl);
        this.window.addRenderer(this.renderer);
        this.gl.setContainer(container);
        this.canvas = container.querySelector('canvas') as HTMLCanvasElement;
        this.mapper.setInputData(this.data);
        this.mapper.setScalarVisibility(false);
        this.actor.setMapper(this.mapper);
        const property = this.actor.getProperty();
        property.setColor(1, 1, 1);
        // A surface that the light only grazes keeps 0.8 of its colour: colours are for reading.
        property.setAmbient(0.8);
        property.setDiffuse(0.2);
        property.setSpecular(0);
        const points = vtkMapper.newInstance();
        points.setInputData(this.coarseData);
        points.setScalarVisibility(false);
        this.coarse.setMapper(points);
        this.coarse.getProperty().setPointSize(4);
        this.coarse.getProperty().setColor(1, 1, 1);
        this.coarse.getProperty().setLighting(false);
        const lines = vtkMapper.newInstance();
        lines.setInputData(this.pathData);
        lines.setScalarVisibility(false);
        this.path.setMapper(lines);
        this.path.getProperty().setLighting(false);
        this.path.getProperty().setLineWidth(1);
        for (const mapper of [this.mapper, points]) replaceInShaders(mapper, [...keepToCovered(), hatchMissing()]);
        this.renderer.addActor(this.path);
        this.renderer.addActor(this.coarse);
        this.renderer.addActor(this.actor);
        this.renderer.getActiveCamera().setParallelProjection(true);
    }

    setMesh(mesh: Mesh, style: Style): void {
        const { xyz } = mesh;
        this.data.getPoints().setData(xyz, 3);
        const empty = new Uint32Array(0);
        const all = style === 'points' ? mesh.points : empty;
        this.data.setPolys(
            vtkCellArray.newInstance({ values: style === 'surface' ? cells(mesh.triangles, 3) : empty }),
        );
        this.data.setLines(vtkCellArray.newInstance({ values: style === 'points' ? empty : cells(mesh.segments, 2) }));
        this.data.setVerts(vtkCellArray.newInstance({ values: cells(all, 1) }));
        const lit = style === 'surface' && mesh.normals;
        const points = this.data.getPointData();
        // vtk.js takes null away what is there, but its types do not say so.
        points.setNormals(
            (lit
                ? vtkDataArray.newInstance({
                      name: 'normals',
                      numberOfComponents: 3,
                      values: mesh.normals as Float32Array,
                  })
                : null) as never,
        );
        this.actor.getProperty().setLighting(Boolean(lit));
        this.actor.getProperty().setPointSize(3);
        this.actor.getProperty().setLineWidth(style === 'lines' ? 1.5 : 1);
        const bounds = [Infinity, -Infinity, Infinity, -Infinity, Infinity, -Infinity];
        for (let i = 0; i < xyz.length; ++i) {
            const k = 2 * (i % 3);
            bounds[k] = Math.min(bounds[k], xyz[i]);
            bounds[k + 1] = Math.max(bounds[k + 1], xyz[i]);
        }
        this.middle = [0, 2, 4].map((k) => (bounds[k] + bounds[k + 1]) / 2);
        this.radius = Math.max(1e-3, Math.hypot(...[0, 2, 4].map((k) => bounds[k + 1] - bounds[k])) / 2);
        this.data.modified();
        this.setCoarsePoints(xyz, mesh.points);
    }

    /** Thin lines that lie in the surface. */
    setPath(xyz: Float32Array, segments: Uint32Array): void {
        this.pathData.getPoints().setData(xyz, 3);
        this.pathData.setLines(vtkCellArray.newInstance({ values: cells(segments, 2) }));
        this.pathData.modified();
    }
    showPath(shown: boolean): void {
        this.path.setVisibility(shown);
    }
    setPathColour(rgb: readonly number[]): void {
        this.path.getProperty().setColor(rgb[0] / 255, rgb[1] / 255, rgb[2] / 255);
    }

    /** Every so many-th vertex. */
    private setCoarsePoints(xyz: Float32Array, points: Uint32Array): void {
        const count = points.length;
        const step = Math.max(1, Math.ceil(count / coarsePoints));
        this.coarseVertices = Uint32Array.from({ length: Math.floor(count / step) }, (_, i) => points[i * step]);
        const some = new Float32Array(3 * this.coarseVertices.length);
        this.coarseVertices.forEach((v, i) => some.set(xyz.subarray(3 * v, 3 * v + 3), 3 * i));
        this.coarseData.getPoints().setData(some, 3);
        this.coarseData.setVerts(
            vtkCellArray.newInstance({
                values: cells(
                    Uint32Array.from(this.coarseVertices, (_, i) => i),
                    1,
                ),
            }),
        );
        this.coarseData.modified();
    }

    /** Shows points in place of the mesh, or the mesh again. Returns whether that changed anything. */
    setCoarse(coarse: boolean): boolean {
        if (this.coarse.getVisibility() === coarse) return false;
        this.coarse.setVisibility(coarse);
        this.actor.setVisibility(!coarse);
        return true;
    }

    /** Places of values on the ramp: u along it, v which row: the ramp, its lighter tone where `pale` has 1, or no value. */
    setValues(values: Float32Array, scale: ColourScale, pale: Uint8Array | null): void {
        const { low, high } = scale;
        const slack = slackAlong(scale);
        const places = new Float32Array(2 * values.length);
        const span = high > low ? high - low : 1;
        for (let i = 0; i < values.length; ++i) {
            const value = values[i];
            const known = value === value;
            let along = known ? (high > low ? (value - low) / span : 0.5) : 0;
            if (along >= -slack && along <= 1 + slack) along = Math.min(Math.max(along, 0), 1);
            places[2 * i] = (1.5 + along * (rampColours - 1)) / texels;
            places[2 * i + 1] = !known ? missingPlace : pale?.[i] ? paleRow : rampRow;
        }
        const array = vtkDataArray.newInstance({ name: 'places', numberOfComponents: 2, values: places });
        this.data.getPointData().setTCoords(array);
        this.data.modified();
        const some = new Float32Array(2 * this.coarseVertices.length);
        this.coarseVertices.forEach((v, i) => some.set(places.subarray(2 * v, 2 * v + 2), 2 * i));
        this.coarseData
            .getPointData()
            .setTCoords(vtkDataArray.newInstance({ name: 'places', numberOfComponents: 2, values: some }));
        this.coarseData.modified();
    }

    setColours(scale: ColourScale): void {
        const pixels = new Uint8ClampedArray(4 * textureRows * texels);
        const put = (row: number, i: number, rgb: Rgb) => pixels.set([...rgb, 255], 4 * (row * texels + i));
        const ramp = rampOf(scale, rampColours);
        ramp.forEach((rgb, i) => put(0, i, rgb));
        paler(ramp).forEach((rgb, i) => put(1, i, rgb));
        for (let i = 0; i < texels; ++i) put(2, i, i < texels / 2 ? this.background : missingColour);
        const texture = vtkTexture.newInstance({ interpolate: scale.bins === 0 });
        texture.setInputData(rampImage(pixels));
        for (const actor of [this.actor, this.coarse]) {
            actor.removeAllTextures();
            actor.addTexture(texture);
        }
    }

    /** Before setColours(), which puts it between the lines of the hatching. */
    setBackground(rgb: Rgb): void {
        this.background = rgb;
        this.renderer.setBackground(rgb[0] / 255, rgb[1] / 255, rgb[2] / 255);
    }

    resize(width: number, height: number, ratio: number): void {
        this.gl.setSize(Math.max(1, Math.round(width * ratio)), Math.max(1, Math.round(height * ratio)));
    }

    /** Draws and waits until it is done [ms]. */
    timeOfPicture(camera: Camera): number {
        const begin = performance.now();
        this.render(camera);
        const gl = this.canvas.getContext('webgl2'); // the one that vtk.js draws with
        if (!gl) return 0;
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits
        return performance.now() - begin;
    }

    render(camera: Camera): void {
        const { up, towards } = camera.axes;
        const eye = this.renderer.getActiveCamera();
        const far = this.radius + Math.hypot(...this.middle.map((m, k) => m - camera.centre[k]));
        const c = camera.centre;
        eye.setFocalPoint(c[0], c[1], c[2]);
        eye.setPosition(c[0] + 2 * far * towards[0], c[1] + 2 * far * towards[1], c[2] + 2 * far * towards[2]);
        // In front of the surface by two pixels, as seen by the eye: else parts of it would be in front of the lines.
        const ahead = 2 * camera.mmPerPixel;
        this.path.setPosition(ahead * towards[0], ahead * towards[1], ahead * towards[2]);
        eye.setViewUp(up[0], up[1], up[2]);
        eye.setParallelScale((camera.mmPerPixel * camera.height) / 2);
        eye.setClippingRange(0.9 * far, 3.1 * far);
        this.window.render();
    }
}
