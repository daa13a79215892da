/**
 * @file vtkElVisReader.h
 * Volumes of ElVis as sources of ParaView: any file that a plugin of ElVis opens or converts.
 */
#ifndef vtkElVisReader_h
#define vtkElVisReader_h

#include "ElVisRepresentationModule.h"

#include <vtkPolyDataAlgorithm.h>

#include <memory>
#include <string>
#include <vector>

namespace elvis_paraview {
struct OpenVolume;
}

/**
 * The output is the box around the volume, on the first rank, and nothing on the others. Its point arrays are named like
 * fields, or like components of fields ("u[0]"), and hold nothing but the range of each, by which ParaView sets its colour
 * maps. The field data name the file and the time step for vtkElVisRepresentation, which draws the volume itself.
 */
class ELVISREPRESENTATION_EXPORT vtkElVisReader : public vtkPolyDataAlgorithm {
public:
    static vtkElVisReader* New();
    vtkTypeMacro(vtkElVisReader, vtkPolyDataAlgorithm);

    void SetFileName(const char* name);
    const char* GetFileName() const { return this->FileName.c_str(); }
    /** Further files of the same foreign data set, as `elvis convert` takes them: fields, then time steps. */
    void AddFurtherFile(const char* name);
    void ClearFurtherFiles();
    /** 1 if a plugin of ElVis opens or converts the file, else 0. */
    int CanReadFile(const char* name);

protected:
    vtkElVisReader();
    ~vtkElVisReader() override;

    int RequestInformation(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
    int RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
    vtkElVisReader(const vtkElVisReader&) = delete;
    void operator=(const vtkElVisReader&) = delete;

    std::vector<std::string> Files() const;
    /** False after an error that was told. */
    bool Open();

    std::string FileName;
    std::vector<std::string> FurtherFiles;
    std::shared_ptr<elvis_paraview::OpenVolume> Volume;
};

#endif
