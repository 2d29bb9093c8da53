// print FILE.vtp: what VTK reads in a file of PolyData, as JSON on standard output, so that the
// tests see `-o FILE.vtp` through VTK's eyes without linking it.
//
//     {"points": [[x, y, z]..], "double": bool, "verts": [[i..]..], "lines": .., "polys": ..,
//      "point_arrays": {NAME: [[component..]..]}, "cell_arrays": .., "fields": {NAME:
//      [text..]}}
//
// A number that is not finite is null.
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <jansson.h>

#include <cmath>
#include <cstdio>

namespace {

json_t *number(double value)
{
    return std::isfinite(value) ? json_real(value) : json_null();
}

json_t *tuples(vtkDataArray *array)
{
    json_t *all = json_array();
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); i++) {
        json_t *tuple = json_array();
        for (int c = 0; c < array->GetNumberOfComponents(); c++) {
            json_array_append_new(tuple, number(array->GetComponent(i, c)));
        }
        json_array_append_new(all, tuple);
    }
    return all;
}

json_t *arrays(vtkFieldData *data)
{
    json_t *all = json_object();
    for (int i = 0; i < data->GetNumberOfArrays(); i++) {
        vtkDataArray *array = data->GetArray(i);
        if (array != nullptr) {
            json_object_set_new(all, array->GetName(), tuples(array));
        }
    }
    return all;
}

json_t *texts(vtkFieldData *data)
{
    json_t *all = json_object();
    for (int i = 0; i < data->GetNumberOfArrays(); i++) {
        auto *array = vtkStringArray::SafeDownCast(data->GetAbstractArray(i));
        json_t *list = json_array();
        for (vtkIdType j = 0; array != nullptr && j < array->GetNumberOfValues(); j++) {
            json_array_append_new(list, json_string(array->GetValue(j).c_str()));
        }
        json_object_set_new(all, data->GetAbstractArray(i)->GetName(), list);
    }
    return all;
}

json_t *cells(vtkCellArray *array)
{
    json_t *all = json_array();
    for (vtkIdType i = 0; i < array->GetNumberOfCells(); i++) {
        vtkIdType count = 0;
        const vtkIdType *points = nullptr;
        array->GetCellAtId(i, count, points);
        json_t *cell = json_array();
        for (vtkIdType j = 0; j < count; j++) {
            json_array_append_new(cell, json_integer(points[j]));
        }
        json_array_append_new(all, cell);
    }
    return all;
}

} // namespace

int main(int argc, char **argv)
{
    vtkNew<vtkXMLPolyDataReader> reader;
    if (argc != 2 || reader->CanReadFile(argv[1]) == 0) {
        std::fprintf(stderr, "print: one file of PolyData (.vtp) must be given\n");
        return 2;
    }
    reader->SetFileName(argv[1]);
    reader->Update();
    vtkPolyData *data = reader->GetOutput();
    json_t *all = json_pack(
        "{s:o,s:b,s:o,s:o,s:o,s:o,s:o,s:o}", "points", tuples(data->GetPoints()->GetData()),
        "double", static_cast<int>(data->GetPoints()->GetDataType() == VTK_DOUBLE), "verts",
        cells(data->GetVerts()), "lines", cells(data->GetLines()), "polys",
        cells(data->GetPolys()), "point_arrays", arrays(data->GetPointData()), "cell_arrays",
        arrays(data->GetCellData()), "fields", texts(data->GetFieldData()));
    bool printed = all != nullptr && json_dumpf(all, stdout, JSON_COMPACT) == 0;
    json_decref(all);
    return printed ? 0 : 1;
}
