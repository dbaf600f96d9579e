// The camera: azimuth and elevation, a centre, millimetres a pixel, by the formulae of viz/view.cpp, so
// that a view can be written as options of `render`. Pure numbers.

export type Vec3 = [number, number, number];

export const views: Record<string, [number, number]> = {
    iso: [45, 35.264389682754654],
    top: [0, 90],
    front: [0, 0],
    left: [-90, 0],
    right: [90, 0],
    back: [180, 0],
    bottom: [0, -90],
};

export const margin = 1.03; // of viz/view.cpp

export const dot = (a: readonly number[], b: readonly number[]) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

export interface Axes {
    right: Vec3;
    up: Vec3;
    towards: Vec3;
}

export function axesOf(azimuth: number, elevation: number): Axes {
    const az = (azimuth * Math.PI) / 180;
    const el = (elevation * Math.PI) / 180;
    const towards: Vec3 = [Math.sin(az) * Math.cos(el), -Math.cos(az) * Math.cos(el), Math.sin(el)];
    const right: Vec3 = [Math.cos(az), Math.sin(az), 0];
    const up: Vec3 = [
        towards[1] * right[2] - towards[2] * right[1],
        towards[2] * right[0] - towards[0] * right[2],
        towards[0] * right[1] - towards[1] * right[0],
    ];
    return { right, up, towards };
}

/** Extent along the axes of a view. */
export interface Extent {
    low: Vec3;
    high: Vec3;
}

export function extentAlong(axes: Axes, xyz: Float32Array, wanted: (vertex: number) => boolean): Extent {
    const low: Vec3 = [Infinity, Infinity, Infinity];
    const high: Vec3 = [-Infinity, -Infinity, -Infinity];
    const rows = [axes.right, axes.up, axes.towards];
    for (let i = 0; 3 * i < xyz.length; ++i) {
        if (!wanted(i)) continue;
        for (let k = 0; k < 3; ++k) {
            const at = rows[k][0] * xyz[3 * i] + rows[k][1] * xyz[3 * i + 1] + rows[k][2] * xyz[3 * i + 2];
            if (at < low[k]) low[k] = at;
            if (at > high[k]) high[k] = at;
        }
    }
    return low[0] <= high[0] ? { low, high } : { low: [0, 0, 0], high: [0, 0, 0] };
}

/** Millimetres a pixel at which an extent is seen whole. */
export function wholeScale(extent: Extent, width: number, height: number): number {
    const scale =
        margin * Math.max((extent.high[0] - extent.low[0]) / width, (extent.high[1] - extent.low[1]) / height);
    return scale > 0 ? scale : 1 / Math.max(1, Math.min(width, height));
}

export class Camera {
    azimuth = views.iso[0];
    elevation = views.iso[1];
    centre: Vec3 = [0, 0, 0];
    mmPerPixel = 1;
    width = 1;
    height = 1;

    get axes(): Axes {
        return axesOf(this.azimuth, this.elevation);
    }
    /** Pixels from the upper left corner, and how near to the eye [mm]. */
    project(p: readonly number[]): Vec3 {
        const { right, up, towards } = this.axes;
        const d = [p[0] - this.centre[0], p[1] - this.centre[1], p[2] - this.centre[2]];
        return [
            dot(right, d) / this.mmPerPixel + this.width / 2,
            this.height / 2 - dot(up, d) / this.mmPerPixel,
            dot(towards, d),
        ];
    }
    turn(dx: number, dy: number): void {
        this.azimuth -= 0.4 * dx;
        this.azimuth -= 360 * Math.round(this.azimuth / 360);
        this.elevation = Math.min(90, Math.max(-90, this.elevation + 0.4 * dy));
    }
    pan(dx: number, dy: number): void {
        const { right, up } = this.axes;
        for (let k = 0; k < 3; ++k) this.centre[k] += this.mmPerPixel * (-dx * right[k] + dy * up[k]);
    }
    /** Zooms by a factor about a pixel. */
    zoom(factor: number, x: number, y: number): void {
        const [dx, dy] = [x - this.width / 2, y - this.height / 2];
        this.pan(-dx, -dy);
        this.mmPerPixel = Math.min(1e4, Math.max(1e-6, this.mmPerPixel * factor));
        this.pan(dx, dy);
    }
    fit(extent: Extent): void {
        const { right, up, towards } = this.axes;
        for (let k = 0; k < 3; ++k) {
            this.centre[k] =
                (right[k] * (extent.low[0] + extent.high[0]) +
                    up[k] * (extent.low[1] + extent.high[1]) +
                    towards[k] * (extent.low[2] + extent.high[2])) /
                2;
        }
        this.mmPerPixel = wholeScale(extent, this.width, this.height);
    }
    copy(): Camera {
        return Object.assign(new Camera(), this, { centre: [...this.centre] });
    }
}
