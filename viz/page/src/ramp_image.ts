// Two rows of colours as an image that vtk.js takes for a texture.

import vtkDataArray from '@kitware/vtk.js/Common/Core/DataArray';
import vtkImageData from '@kitware/vtk.js/Common/DataModel/ImageData';

export function rampImage(rgba: Uint8ClampedArray): vtkImageData {
    const image = vtkImageData.newInstance();
    image.setDimensions([rgba.length / 8, 2, 1]);
    image
        .getPointData()
        .setScalars(vtkDataArray.newInstance({ name: 'colours', numberOfComponents: 4, values: new Uint8Array(rgba) }));
    return image;
}
