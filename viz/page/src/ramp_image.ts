// Rows of colours as an image that vtk.js takes for a texture.

import vtkDataArray from '@kitware/vtk.js/Common/Core/DataArray';
import vtkImageData from '@kitware/vtk.js/Common/DataModel/ImageData';

export const textureRows = 3;

export function rampImage(rgba: Uint8ClampedArray): vtkImageData {
    const image = vtkImageData.newInstance();
    image.setDimensions([rgba.length / (4 * textureRows), textureRows, 1]);
    image
        .getPointData()
        .setScalars(vtkDataArray.newInstance({ name: 'colours', numberOfComponents: 4, values: new Uint8Array(rgba) }));
    return image;
}
