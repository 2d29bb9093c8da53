// The numbers behind a picture as a file for ParaView: everything that was kept, appended to
// one PolyData. Nothing is rendered for it.
//
// vtkAppendPolyData keeps only arrays that all its inputs have. So each input is first given
// those it lacks, filled with what stands for "none": NaN, -1, the largest of an unsigned type.
#include "figure.hh"

extern "C" {
#include "file.h"
}

#include <vtkAppendPolyData.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using datasets = std::vector<vtkSmartPointer<vtkPolyData>>;

/// What an entry holds that has no such number.
double none_of(vtkDataArray *array)
{
    int type = array->GetDataType();
    if (type == VTK_FLOAT || type == VTK_DOUBLE) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    return array->GetDataTypeMin() < 0.0 ? -1.0 : array->GetDataTypeMax();
}

/// An array like `pattern`, without a number in any entry.
vtkSmartPointer<vtkDataArray> make_none(vtkDataArray *pattern, vtkIdType count)
{
    vtkSmartPointer<vtkDataArray> array;
    array.TakeReference(pattern->NewInstance());
    array->SetName(pattern->GetName());
    array->SetNumberOfComponents(pattern->GetNumberOfComponents());
    array->SetNumberOfTuples(count);
    array->Fill(none_of(pattern));
    return array;
}

/// `to` gets what it lacks of `from`'s arrays, with `count` entries each.
void complete(vtkFieldData *to, vtkFieldData *from, vtkIdType count)
{
    for (int i = 0; i < from->GetNumberOfArrays(); i++) {
        vtkDataArray *pattern = from->GetArray(i);
        if (pattern == nullptr || pattern->GetName() == nullptr) {
            throw std::runtime_error("an array behind this picture has no name or no numbers");
        }
        vtkDataArray *there = to->GetArray(pattern->GetName());
        if (there == nullptr) {
            to->AddArray(make_none(pattern, count));
        } else if (there->GetDataType() != pattern->GetDataType() ||
                   there->GetNumberOfComponents() != pattern->GetNumberOfComponents()) {
            throw std::runtime_error(std::string("two arrays behind this picture are called ") +
                                     pattern->GetName() + " and differ in kind");
        }
    }
}

/// The scene file's coordinates: in double where a centre is added, so that no digit is lost.
vtkSmartPointer<vtkPoints> move(vtkPoints *points, pm_vec3 center)
{
    if (center.x == 0.0 && center.y == 0.0 && center.z == 0.0) {
        return points;
    }
    auto moved = vtkSmartPointer<vtkPoints>::New();
    moved->SetDataTypeToDouble();
    moved->SetNumberOfPoints(points->GetNumberOfPoints());
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); i++) {
        double at[3];
        points->GetPoint(i, at);
        moved->SetPoint(i, at[0] + center.x, at[1] + center.y, at[2] + center.z);
    }
    return moved;
}

/// Which kind of thing each cell is: a number into the list of names.
void add_kind(vtkPolyData *data, vtkStringArray *names, const std::string &name)
{
    vtkNew<vtkIntArray> kind;
    vtkIdType number = names->LookupValue(name);
    if (number < 0) {
        number = names->InsertNextValue(name);
    }
    kind->SetName("kind");
    kind->SetNumberOfTuples(data->GetNumberOfCells());
    kind->FillValue(static_cast<int>(number));
    data->GetCellData()->AddArray(kind);
}

/// Points and cells of a data set are shared, its lists of arrays are not.
datasets copy_datasets(const pm_figure *figure, pm_vec3 center, vtkStringArray *names)
{
    datasets copies;
    for (const pm_dataset &dataset : figure->datasets) {
        auto copy = vtkSmartPointer<vtkPolyData>::New();
        copy->ShallowCopy(dataset.data);
        copy->SetPoints(move(dataset.data->GetPoints(), center));
        copy->GetPointData()->SetActiveScalars(nullptr);
        copy->GetCellData()->SetActiveScalars(nullptr);
        add_kind(copy, names, dataset.name);
        copies.push_back(copy);
    }
    return copies;
}

vtkSmartPointer<vtkPolyData> append(const datasets &parts)
{
    vtkNew<vtkAppendPolyData> appended;
    for (const auto &to : parts) {
        for (const auto &from : parts) {
            complete(to->GetPointData(), from->GetPointData(), to->GetNumberOfPoints());
            complete(to->GetCellData(), from->GetCellData(), to->GetNumberOfCells());
        }
        appended->AddInputData(to);
    }
    appended->SetOutputPointsPrecision(parts[0]->GetPoints()->GetDataType() == VTK_DOUBLE
                                           ? vtkAlgorithm::DOUBLE_PRECISION
                                           : vtkAlgorithm::DEFAULT_PRECISION);
    appended->Update();
    return appended->GetOutput();
}

vtkSmartPointer<vtkPolyData> collect(const pm_figure *figure, pm_vec3 center)
{
    vtkNew<vtkStringArray> names;
    names->SetName("kinds");
    datasets parts = copy_datasets(figure, center, names);
    vtkSmartPointer<vtkPolyData> all = parts.size() > 1 ? append(parts) : parts[0];
    for (const auto &part : parts) {
        vtkFieldData *fields = part->GetFieldData();
        for (int i = 0; i < fields->GetNumberOfArrays(); i++) {
            all->GetFieldData()->AddArray(fields->GetAbstractArray(i));
        }
    }
    all->GetFieldData()->AddArray(names);
    return all;
}

/// Appended raw with the fastest compression: 25 MB and a second for a million photons.
pm_status write(vtkPolyData *data, const pm_file *file)
{
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(data);
    writer->SetFileName(file->temporary);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToZLib();
    writer->SetCompressionLevel(1);
    bool written = writer->Write() == 1 && writer->GetErrorCode() == 0;
    if (written && pm_figure_fault().empty()) {
        return PM_OK;
    }
    return pm_status_fail(PM_EIO, "%s: VTK cannot write it whole; is there room on its disk?",
                          file->path);
}

pm_status export_to(pm_figure *figure, const pm_file *file, pm_vec3 center)
{
    return pm_figure_guard("the data behind a picture",
                           [&] { return write(collect(figure, center), file); });
}

} // namespace

pm_status pm_figure_export(pm_figure *figure, const char *path, pm_vec3 center)
{
    if (figure->datasets.empty()) {
        return pm_status_fail(PM_EINPUT,
                              "%s: there are no numbers in space behind this picture; photons, "
                              "paths, tree and irradiance have some",
                              path);
    }
    pm_file file = {};
    PM_TRY(pm_file_begin(path, &file));
    pm_status status = export_to(figure, &file, center);
    if (status != PM_OK) {
        pm_file_abandon(&file);
        return status;
    }
    return pm_file_commit(&file);
}
