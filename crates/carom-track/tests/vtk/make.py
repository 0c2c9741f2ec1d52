"""Writes the flow tables that the tests of VTK XML read, with the vtk package (pip install vtk; 9.7.2 was used).

usage: make.py, in this folder. The field is linear or bilinear in the cells: u = 1 + 2x + 3y - z, v = xy/4, w = -z, k = 0.5 + x,
epsilon = 4 + y on x = 0, 0.5, 1.5, y = 0, 1, z = -1, 0.
"""

from vtkmodules.vtkIOXML import vtkXMLRectilinearGridWriter, vtkXMLImageDataWriter
from vtkmodules.vtkCommonDataModel import vtkRectilinearGrid, vtkImageData
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkFloatArray
def arr(cls,name,vals,comps=1):
    a=cls(); a.SetName(name); a.SetNumberOfComponents(comps); a.SetNumberOfTuples(len(vals)//comps)
    for i,v in enumerate(vals): a.SetValue(i,v)
    return a
X=[0.0,0.5,1.5]; Y=[0.0,1.0]; Z=[-1.0,0.0]
g=vtkRectilinearGrid(); g.SetDimensions(3,2,2)
g.SetXCoordinates(arr(vtkDoubleArray,"x",X)); g.SetYCoordinates(arr(vtkDoubleArray,"y",Y)); g.SetZCoordinates(arr(vtkFloatArray,"z",Z))
U=[];k=[];e=[];p=[]
for z in Z:
    for y in Y:
        for x in X:
            U+=[1+2*x+3*y-z, 0.25*x*y, -z]; k.append(0.5+x); e.append(4.0+y); p.append(7.0)
pd=g.GetPointData(); pd.AddArray(arr(vtkFloatArray,"p",p)); pd.AddArray(arr(vtkDoubleArray,"U",U,3)); pd.AddArray(arr(vtkFloatArray,"k",k)); pd.AddArray(arr(vtkDoubleArray,"epsilon",e))
def write(name, mode, comp=None, encode=True, header=32, big=False, block=None):
    w=vtkXMLRectilinearGridWriter(); w.SetInputData(g); w.SetFileName(name)
    {"ascii":w.SetDataModeToAscii,"binary":w.SetDataModeToBinary,"appended":w.SetDataModeToAppended}[mode]()
    {None:w.SetCompressorTypeToNone,"zlib":w.SetCompressorTypeToZLib,"lz4":w.SetCompressorTypeToLZ4,"lzma":w.SetCompressorTypeToLZMA}[comp]()
    w.SetEncodeAppendedData(encode)
    (w.SetHeaderTypeToUInt64 if header==64 else w.SetHeaderTypeToUInt32)()
    if big: w.SetByteOrderToBigEndian()
    if block: w.SetBlockSize(block)
    assert w.Write()==1
write("ascii.vtr","ascii"); 
w=vtkXMLRectilinearGridWriter(); w.SetInputData(g); w.SetFileName("default.vtr"); w.Write()
write("inline.vtr","binary"); write("inline-zlib.vtr","binary","zlib",header=64)
write("raw.vtr","appended",encode=False,header=64); write("raw-zlib-blocks.vtr","appended","zlib",encode=False,block=64)
write("base64.vtr","appended"); write("base64-zlib-big.vtr","appended","zlib",big=True,block=64)
write("lz4.vtr","appended","lz4")
im=vtkImageData(); im.SetDimensions(3,2,2); im.SetOrigin(0,0,-1); im.SetSpacing(.5,1,1); im.GetPointData().AddArray(arr(vtkDoubleArray,"U",U,3))
w=vtkXMLImageDataWriter(); w.SetInputData(im); w.SetFileName("image.vti"); w.Write()
