#pragma once

#include <memory>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

/// One pass over an image from top to bottom.
class AZULEJO_EXPORT RowReader {
 public:
  virtual ~RowReader() = default;
  /// Fills `rows` with the rows [y, y + rows.height()) of the image, full width. Calls come in order: each y is
  /// where the last call ended, or further down. Throws Error(Data), naming the file and the place.
  virtual void read(int y, const AnyView& rows) = 0;
};

/// Where a computation gets an image from: memory or a file.
class AZULEJO_EXPORT ImageSource {
 public:
  virtual ~ImageSource() = default;
  virtual const ImageInfo& info() const = 0;
  virtual const Metadata& metadata() const = 0;
  /// The image, if all of it is in memory already: then nothing else is asked.
  virtual const Image* image() const { return nullptr; }
  /// Starts a pass. A source may be read several times, one pass after another.
  virtual std::unique_ptr<RowReader> rows(const Run& run) = 0;
  /// Rows that are cheap to read together: a row of the file's tiles, a strip. 1: any.
  virtual int row_group() const { return 1; }
};

/// Where a computation puts an image, from top to bottom.
class AZULEJO_EXPORT ImageSink {
 public:
  virtual ~ImageSink() = default;
  /// The next rows, full width, of the type and channels that the sink was made for.
  virtual void write(const ConstAnyView& rows) = 0;
  /// All rows were given. Until this returns nothing is to be seen under the result's name; a sink destroyed
  /// before leaves nothing behind.
  virtual void finish() = 0;
  /// Rows that are best given together (the last group may be shorter). 1: any.
  virtual int row_group() const { return 1; }
};

}  // namespace azulejo
